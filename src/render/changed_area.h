// Which part of a picture differs from the one before it, while the camera rests: where cloth and moving
// solids are and were, and where their shadows fall. The rest can be kept, pixel for pixel.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/colliders.h"

namespace clothsim {

// Pixels from left and bottom to right and top, which do not belong to it.
struct PixelRect {
  int left = 0, bottom = 0, right = 0, top = 0;
  [[nodiscard]] int width() const { return std::max(0, right - left); }
  [[nodiscard]] int height() const { return std::max(0, top - bottom); }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

// A rectangle of reals; empty until something is added.
struct FlatBounds {
  glm::vec2 low{1e30f}, high{-1e30f};
  void add(glm::vec2 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const FlatBounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  [[nodiscard]] FlatBounds grown(float by) const { return {low - by, high + by}; }
  [[nodiscard]] bool overlaps(const FlatBounds& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
};

class ChangedArea {
 public:
  struct View {
    glm::mat4 clipFromWorld, shadowFromWorld;
    int width, height;  // of the picture [pixels]
    float reach = 0;    // how far from the particles the surface may be [m]
    friend bool operator==(const View&, const View&) = default;
  };
  struct Area {
    PixelRect picture;
    FlatBounds shadow;  // in the shadow map, 0 to 1 in each coordinate
  };

  // What has changed since the last call. None: everything, as when the camera or a plane has moved.
  [[nodiscard]] std::optional<Area> next(const View& view, std::span<const glm::vec4> particles,
                                         const Colliders& colliders);
  // Where a plane is seen that a picture without shadows, and with nothing before it or below it, does not
  // show already: where the shadows of particles and solids may fall, and where it hides any [pixels].
  // None: that is unknown.
  [[nodiscard]] static std::optional<PixelRect> shadowsOn(const PlaneDisc& plane, const View& view,
                                                          std::span<const glm::vec4> particles,
                                                          const Colliders& colliders);
  // The next picture is new everywhere.
  void forget() { last_.reset(); }

 private:
  struct Seen {
    View view;
    std::vector<SolidPlace> solids;
    std::vector<PlaneDisc> planes;
    FlatBounds picture, shadow;  // of the cloth: pixels; 0 to 1
    [[nodiscard]] bool isComparable(const Seen& other) const;
  };
  std::optional<Seen> last_;
};

}  // namespace clothsim
