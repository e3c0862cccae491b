#include "render/changed_area.h"

#include <array>
#include <cmath>
#include <utility>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

// Smoothing of edges looks this far [pixels], and marks of pins are this large, as a part of the height.
constexpr float smoothingMargin = 24, marksMargin = 0.007f;
// The blur of shadows on floors, and a texel for filters.
constexpr float shadowMargin = 9.0f / FLOOR_SHADOW_SIZE;

glm::vec2 sizeOf(const ChangedArea::View& view) { return {view.width, view.height}; }

// By how much the first two coordinates change for a metre, at most.
float lengthOfRows(const glm::mat4& m) {
  return std::max(glm::length(glm::vec3(m[0].x, m[1].x, m[2].x)),
                  glm::length(glm::vec3(m[0].y, m[1].y, m[2].y)));
}

// Adds a point of the world to what is seen. False for one that has no place in the picture.
bool addSeen(glm::vec3 point, const ChangedArea::View& view, FlatBounds& seen) {
  const glm::vec4 clip = view.clipFromWorld * glm::vec4(point, 1);
  if (!(clip.w > NEAREST_SEEN)) return false;  // not a number, too
  seen.add(pixelOf(clip, sizeOf(view)));
  return true;
}

// From the shadow map to where on a plane its light falls.
class ShadowOnPlane {
 public:
  ShadowOnPlane(const PlaneDisc& plane, const ChangedArea::View& view)
      : normal_(plane.normal),
        center_(plane.place),
        view_(view),
        worldFromShadow_(glm::inverse(view.shadowFromWorld)) {}

  // Of a part of the map what is before the eye. False: it has no end, since the light grazes the plane.
  bool add(const FlatBounds& inMap, FlatBounds& seen) const {
    std::array<glm::vec4, 4> clip;  // around the shadow
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const float u = corner == 1 || corner == 2 ? inMap.high.x : inMap.low.x;
      const float v = corner >= 2 ? inMap.high.y : inMap.low.y;
      const glm::vec3 from(worldFromShadow_ * glm::vec4(u, v, 0, 1)),
          to(worldFromShadow_ * glm::vec4(u, v, 1, 1));
      const float slope = glm::dot(to - from, normal_);
      if (std::abs(slope) < 1e-3f * glm::length(to - from)) return false;
      clip[corner] =
          view_.clipFromWorld * glm::vec4(from + glm::dot(center_ - from, normal_) / slope * (to - from), 1);
      if (!std::isfinite(clip[corner].w)) return false;
    }
    for (std::size_t corner = 0; corner < 4; ++corner)
      addSide(clip[corner], clip[(corner + 1) % 4], sizeOf(view_), seen);
    return true;
  }

 private:
  glm::vec3 normal_, center_;
  const ChangedArea::View& view_;
  glm::mat4 worldFromShadow_;
};

// Cell by cell; `see` takes the pixels of each.
template <class See>
bool seeShadowOn(const PlaneDisc& plane, const ShadowFootprint& shadow, const ChangedArea::View& view,
                 const See& see) {
  const ShadowOnPlane falls(plane, view);
  for (int row = 0; row < ShadowFootprint::CELLS; ++row)
    for (int column = 0; column < ShadowFootprint::CELLS; ++column) {
      if (!shadow.has(column, row)) continue;
      FlatBounds seen;
      if (!falls.add(ShadowFootprint::cell(column, row), seen)) return false;
      see(seen);
    }
  return true;
}

// The box of a solid in the map and in the picture.
bool addBox(const Bounds& box, const ChangedArea::View& view, ShadowFootprint& shadow, FlatBounds& seen,
            float margin = shadowMargin) {
  FlatBounds inMap;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 point{(corner & 1) != 0 ? box.high.x : box.low.x,
                          (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z};
    inMap.add(glm::vec2(view.shadowFromWorld * glm::vec4(point, 1)));
    if (!addSeen(point, view, seen)) return false;
  }
  shadow.add(inMap.grown(margin));
  return true;
}

// All that smoothing changes.
FlatBounds smoothed(const FlatBounds& seen, const ChangedArea::View& view) {
  return seen.grown(smoothingMargin + marksMargin * static_cast<float>(view.height));
}

PixelRect pixelsOf(const FlatBounds& seen, int width, int height) {
  const auto clipped = [](float at, int size) {
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(size)));
  };
  return {clipped(std::floor(seen.low.x), width), clipped(std::floor(seen.low.y), height),
          clipped(std::ceil(seen.high.x), width), clipped(std::ceil(seen.high.y), height)};
}

}  // namespace

PixelBands::PixelBands(int width, int height) : width_(width) {
  for (int bottom = 0; bottom < height; bottom += HEIGHT)
    bands_.push_back({width, bottom, 0, std::min(bottom + HEIGHT, height)});
}

void PixelBands::add(const FlatBounds& seen) {
  if (bands_.empty()) return;
  const PixelRect part = pixelsOf(seen, width_, bands_.back().top);
  if (part.width() == 0 || part.height() == 0) return;
  for (int i = part.bottom / HEIGHT; i <= (part.top - 1) / HEIGHT; ++i) {
    PixelRect& band = bands_[static_cast<std::size_t>(i)];
    band.left = std::min(band.left, part.left);
    band.right = std::max(band.right, part.right);
  }
}

std::optional<ChangedArea::ClothPlace> ChangedArea::placeOf(const Cloth& cloth,
                                                            std::span<const glm::vec4> particles,
                                                            const View& view) {
  ClothPlace place;
  if (particles.empty()) return place;
  std::vector<glm::vec2> inMap;
  inMap.reserve(particles.size());
  float nearestW = 1e30f;
  for (const glm::vec4& particle : particles) {
    const glm::vec4 at(glm::vec3(particle), 1);
    inMap.emplace_back(view.shadowFromWorld * at);
    if (!addSeen(glm::vec3(particle), view, place.picture)) return std::nullopt;
    nearestW = std::min(nearestW, (view.clipFromWorld * at).w);
  }
  // At most so far in the map, and in pixels where the cloth is nearest.
  place.shadow = footprintOf(cloth, inMap, view.reach * lengthOfRows(view.shadowFromWorld) + shadowMargin);
  place.picture = place.picture.grown(0.5f * static_cast<float>(std::max(view.width, view.height)) *
                                      view.reach * lengthOfRows(view.clipFromWorld) / nearestW);
  return place;
}

std::optional<PixelBands> ChangedArea::shadowsOn(const PlaneDisc& plane, const View& view,
                                                 const ClothPlace& place,
                                                 std::span<const glm::vec4> particles,
                                                 const Colliders& colliders) {
  constexpr float mostBelow = 2e-3f;  // [m]: so much lies in the plane, and in its own shadow
  constexpr float filtered = 1;       // [pixels] around
  const glm::vec3 normal(plane.normal), center(plane.place);
  const auto isBelow = [&](glm::vec3 point) { return !(glm::dot(point - center, normal) > -mostBelow); };
  ShadowFootprint shadow = place.shadow;
  FlatBounds hidden;
  for (const glm::vec4& particle : particles)
    if (isBelow(glm::vec3(particle)) && !addSeen(glm::vec3(particle), view, hidden)) return {};
  for (const SolidPlace& solid : colliders.solids()) {
    const glm::vec3 lowest = glm::mix(solid.box.high, solid.box.low, glm::greaterThan(normal, glm::vec3(0)));
    FlatBounds inPicture;
    if (!addBox(solid.box, view, shadow, inPicture)) return {};
    if (isBelow(lowest)) hidden.add(inPicture);
  }
  PixelBands bands(view.width, view.height);
  bands.add(smoothed(hidden, view));
  const auto see = [&](const FlatBounds& seen) { bands.add(seen.grown(filtered)); };
  if (!seeShadowOn(plane, shadow, view, see)) return {};
  return bands;
}

std::optional<ChangedArea::Area> ChangedArea::next(const View& view, const ClothPlace& place,
                                                   const Colliders& colliders) {
  const Seen now{view, colliders.solids(), colliders.discs(), place};
  const std::optional<Seen> before = std::exchange(last_, now);
  if (!before || before->view.shadowFromWorld != view.shadowFromWorld || before->planes != now.planes ||
      before->solids.size() != now.solids.size())
    return std::nullopt;
  ShadowFootprint shadow = place.shadow;
  shadow.add(before->cloth.shadow);
  FlatBounds picture = place.picture;
  picture.add(before->cloth.picture);
  bool isSeen = true;
  for (std::size_t i = 0; i < now.solids.size(); ++i) {
    if (now.solids[i] == before->solids[i]) continue;
    isSeen = isSeen && addBox(before->solids[i].box, view, shadow, picture) &&
             addBox(now.solids[i].box, view, shadow, picture);
  }
  const FlatBounds changed = shadow.bounds();
  if (isSeen && !(before->view == view)) return Area{{0, 0, view.width, view.height}, changed};
  for (const PlaneDisc& plane : colliders.discs())
    isSeen = isSeen && seeShadowOn(plane, shadow, view, [&](const FlatBounds& seen) { picture.add(seen); });
  for (const SolidPlace& solid : colliders.solids()) {
    ShadowFootprint boxShadow;
    FlatBounds boxPicture;
    isSeen = isSeen && addBox(solid.box, view, boxShadow, boxPicture, 0);
    if (shadow.overlaps(boxShadow)) picture.add(boxPicture);
  }
  if (!isSeen) return std::nullopt;
  return Area{pixelsOf(smoothed(picture, view), view.width, view.height), changed};
}

}  // namespace clothsim
