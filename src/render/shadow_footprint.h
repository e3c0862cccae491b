// Where shadows may fall in the shadow map, as a raster: cloth and its shadow are seldom rectangles.
#pragma once

#include <bitset>
#include <span>

#include "cloth/cloth.h"
#include "render/flat_bounds.h"

namespace clothsim {

class ShadowFootprint {
 public:
  static constexpr int CELLS = 64;  // along each side of the map

  // Boxes in the map, 0 to 1 in each coordinate. What is outside of it casts no shadow.
  void add(const FlatBounds& box);
  void add(const ShadowFootprint& other) { cells_ |= other.cells_; }
  [[nodiscard]] bool has(int column, int row) const { return cells_[index(column, row)]; }
  [[nodiscard]] FlatBounds bounds() const;  // empty where nothing was added
  [[nodiscard]] bool overlaps(const ShadowFootprint& other) const { return (cells_ & other.cells_).any(); }
  [[nodiscard]] static FlatBounds cell(int column, int row) {
    const glm::vec2 low(column, row);
    return {low / static_cast<float>(CELLS), (low + 1.0f) / static_cast<float>(CELLS)};
  }

 private:
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(row) * CELLS + static_cast<std::size_t>(column);
  }
  std::bitset<static_cast<std::size_t>(CELLS) * CELLS> cells_;
};

// That of a cloth whose particles are at these places of the map; `margin` goes around all of it.
[[nodiscard]] ShadowFootprint footprintOf(const Cloth& cloth, std::span<const glm::vec2> places,
                                          float margin);

}  // namespace clothsim
