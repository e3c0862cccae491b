// Into which points and triangles the smooth surface divides the cells of a grid. The numbers do not depend
// on where the particles are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

struct Refinement {
  Piece grid;  // of the points
  std::uint32_t pointCount = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of points, turned as those of the cloth
  // Of a grid with two steps the points that are no particles, for smooth_choose.comp. On sides of cells
  // three words each: the point, the particle whose place it can take, the one on the other side of it. In
  // the middle of cells the point, the same at the ends of the diagonal, and the points on the four sides.
  std::vector<std::uint32_t> sides, centers;
  std::vector<std::array<float, 2>> textureCoordinates;  // of the points
};

// Of a grid whose cells have `steps`, a power of two, on each side. Points are numbered from `firstPoint`,
// row by row: those of the grid with steps - 1 more between each two.
[[nodiscard]] Refinement refineGrid(const Piece& grid, std::uint32_t steps, std::uint32_t firstPoint);

}  // namespace clothsim
