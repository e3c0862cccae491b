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
constexpr float nearest = 1e-3f;  // [m] before the eye

glm::vec2 pixelOf(glm::vec4 clip, const ChangedArea::View& view) {
  return 0.5f * (glm::vec2(clip.x, clip.y) / clip.w + 1.0f) * glm::vec2(view.width, view.height);
}

// By how much the first two coordinates change for a metre, at most.
float lengthOfRows(const glm::mat4& m) {
  return std::max(glm::length(glm::vec3(m[0].x, m[1].x, m[2].x)),
                  glm::length(glm::vec3(m[0].y, m[1].y, m[2].y)));
}

// Adds a point of the world to what is seen. False for one that has no place in the picture.
bool addSeen(glm::vec3 point, const ChangedArea::View& view, FlatBounds& seen) {
  const glm::vec4 clip = view.clipFromWorld * glm::vec4(point, 1);
  if (!(clip.w > nearest)) return false;  // not a number, too
  seen.add(pixelOf(clip, view));
  return true;
}

// Where the shadow falls on a plane: the corners of its part of the map, followed along the light.
bool addShadowOn(const PlaneDisc& plane, const FlatBounds& shadow, const ChangedArea::View& view,
                 FlatBounds& seen) {
  const glm::mat4 worldFromShadow = glm::inverse(view.shadowFromWorld);
  const glm::vec3 normal(plane.normal), center(plane.place);
  const FlatBounds inMap{glm::max(shadow.low, 0.0f), glm::min(shadow.high, 1.0f)};
  std::array<glm::vec4, 4> clip;  // around the shadow
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const float u = corner == 1 || corner == 2 ? inMap.high.x : inMap.low.x;
    const float v = corner >= 2 ? inMap.high.y : inMap.low.y;
    const glm::vec3 from(worldFromShadow * glm::vec4(u, v, 0, 1)),
        to(worldFromShadow * glm::vec4(u, v, 1, 1));
    const float slope = glm::dot(to - from, normal);
    if (std::abs(slope) < 1e-3f * glm::length(to - from)) return false;  // the light grazes it
    clip[corner] =
        view.clipFromWorld * glm::vec4(from + glm::dot(center - from, normal) / slope * (to - from), 1);
    if (!std::isfinite(clip[corner].w)) return false;
  }
  // What of it is before the eye.
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const glm::vec4 a = clip[corner], b = clip[(corner + 1) % 4];
    if (a.w >= nearest) seen.add(pixelOf(a, view));
    if ((a.w >= nearest) != (b.w >= nearest))
      seen.add(pixelOf(glm::mix(a, b, (nearest - a.w) / (b.w - a.w)), view));
  }
  return true;
}

// The box of a solid in the map and in the picture.
bool addBox(const Bounds& box, const ChangedArea::View& view, FlatBounds& shadow, FlatBounds& seen) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 point{(corner & 1) != 0 ? box.high.x : box.low.x,
                          (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z};
    shadow.add(glm::vec2(view.shadowFromWorld * glm::vec4(point, 1)));
    if (!addSeen(point, view, seen)) return false;
  }
  return true;
}

PixelRect pixelsOf(const FlatBounds& seen, const ChangedArea::View& view) {
  const FlatBounds grown = seen.grown(smoothingMargin + marksMargin * static_cast<float>(view.height));
  const auto clipped = [](float at, int size) {
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(size)));
  };
  return {clipped(std::floor(grown.low.x), view.width), clipped(std::floor(grown.low.y), view.height),
          clipped(std::ceil(grown.high.x), view.width), clipped(std::ceil(grown.high.y), view.height)};
}

}  // namespace

// Whether pictures of both differ only by what moves.
bool ChangedArea::Seen::isComparable(const Seen& other) const {
  return view == other.view && planes == other.planes && solids.size() == other.solids.size();
}

std::optional<PixelRect> ChangedArea::shadowsOn(const PlaneDisc& plane, const View& view,
                                                std::span<const glm::vec4> particles,
                                                const Colliders& colliders) {
  constexpr float mostBelow = 2e-3f;  // [m]: so much lies in the plane, and in its own shadow
  const glm::vec3 normal(plane.normal), center(plane.place);
  const auto isBelow = [&](glm::vec3 point) { return !(glm::dot(point - center, normal) > -mostBelow); };
  FlatBounds shadow, seen;
  for (const glm::vec4& particle : particles) {
    const glm::vec3 place(particle);
    if (isBelow(place) && !addSeen(place, view, seen)) return {};
    shadow.add(glm::vec2(view.shadowFromWorld * glm::vec4(place, 1)));
  }
  if (!particles.empty()) shadow = shadow.grown(view.reach * lengthOfRows(view.shadowFromWorld));
  for (const SolidPlace& solid : colliders.solids()) {
    const glm::vec3 lowest = glm::mix(solid.box.high, solid.box.low, glm::greaterThan(normal, glm::vec3(0)));
    FlatBounds inPicture;
    if (!addBox(solid.box, view, shadow, inPicture)) return {};
    if (isBelow(lowest)) seen.add(inPicture);
  }
  if (!addShadowOn(plane, shadow.grown(shadowMargin), view, seen)) return {};
  return pixelsOf(seen, view);
}

std::optional<ChangedArea::Area> ChangedArea::next(const View& view, std::span<const glm::vec4> particles,
                                                   const Colliders& colliders) {
  Seen now{view, colliders.solids(), colliders.discs(), {}, {}};
  float nearestW = 1e30f;
  for (const glm::vec4& particle : particles) {
    const glm::vec3 place(particle);
    now.shadow.add(glm::vec2(view.shadowFromWorld * glm::vec4(place, 1)));
    if (!addSeen(place, view, now.picture)) return forget(), std::nullopt;
    nearestW = std::min(nearestW, (view.clipFromWorld * glm::vec4(place, 1)).w);
  }
  if (!particles.empty()) {
    // At most so far in the map, and in pixels where the cloth is nearest.
    now.shadow = now.shadow.grown(view.reach * lengthOfRows(view.shadowFromWorld));
    now.picture = now.picture.grown(0.5f * static_cast<float>(std::max(view.width, view.height)) *
                                    view.reach * lengthOfRows(view.clipFromWorld) / nearestW);
  }
  if (!last_ || !last_->isComparable(now)) {
    last_ = std::move(now);
    return std::nullopt;
  }
  FlatBounds shadow = now.shadow, picture = now.picture;
  shadow.add(last_->shadow);
  picture.add(last_->picture);
  bool isSeen = true;
  for (std::size_t i = 0; i < now.solids.size(); ++i) {
    if (now.solids[i] == last_->solids[i]) continue;
    isSeen = isSeen && addBox(last_->solids[i].box, view, shadow, picture) &&
             addBox(now.solids[i].box, view, shadow, picture);
  }
  last_ = std::move(now);
  shadow = shadow.grown(shadowMargin);
  for (const PlaneDisc& plane : colliders.discs())
    isSeen = isSeen && addShadowOn(plane, shadow, view, picture);
  for (const SolidPlace& solid : colliders.solids()) {
    FlatBounds boxShadow, boxPicture;
    isSeen = isSeen && addBox(solid.box, view, boxShadow, boxPicture);
    if (boxShadow.overlaps(shadow)) picture.add(boxPicture);
  }
  if (!isSeen) return std::nullopt;
  return Area{pixelsOf(picture, view), shadow};
}

}  // namespace clothsim
