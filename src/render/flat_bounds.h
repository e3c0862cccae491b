// Rectangles of a picture or of a shadow map.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace clothsim {

// Pixels from left and bottom to right and top, which do not belong to it.
struct PixelRect {
  int left = 0, bottom = 0, right = 0, top = 0;
  [[nodiscard]] int width() const { return std::max(0, right - left); }
  [[nodiscard]] int height() const { return std::max(0, top - bottom); }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

// What two rectangles have in common, which may be nothing.
[[nodiscard]] inline PixelRect common(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.left, b.left), std::max(a.bottom, b.bottom), std::min(a.right, b.right),
          std::min(a.top, b.top)};
}

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

inline constexpr float NEAREST_SEEN = 1e-3f;  // [m] before the eye

[[nodiscard]] inline glm::vec2 pixelOf(glm::vec4 clip, glm::vec2 picture) {
  return 0.5f * (glm::vec2(clip.x, clip.y) / clip.w + 1.0f) * picture;
}

// Adds the pixels of what of a side is before the eye; its ends are in clip space.
inline void addSide(glm::vec4 a, glm::vec4 b, glm::vec2 picture, FlatBounds& seen) {
  if (a.w >= NEAREST_SEEN) seen.add(pixelOf(a, picture));
  if (b.w >= NEAREST_SEEN) seen.add(pixelOf(b, picture));
  if ((a.w >= NEAREST_SEEN) != (b.w >= NEAREST_SEEN))
    seen.add(pixelOf(glm::mix(a, b, (NEAREST_SEEN - a.w) / (b.w - a.w)), picture));
}

}  // namespace clothsim
