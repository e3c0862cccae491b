#include "render/refinement.h"

namespace clothsim {
namespace {

// Diagonals run from upper right to lower left, as in the cloth.
void appendMiddles(const Piece& points, Refinement& refinement) {
  for (int row = 0; row < points.rows; ++row) {
    for (int column = 0; column < points.columns; ++column) {
      const auto at = [&](int right, int down) { return points.particle(column + right, row + down); };
      const bool isBetweenColumns = column % 2 != 0, isBetweenRows = row % 2 != 0;
      std::vector<std::uint32_t>& sides = refinement.sides;
      if (isBetweenColumns && isBetweenRows)
        refinement.centers.insert(refinement.centers.end(),
                                  {at(0, 0), at(-1, 1), at(1, -1), at(-1, 0), at(1, 0), at(0, -1), at(0, 1)});
      else if (isBetweenColumns)
        sides.insert(sides.end(), {at(0, 0), at(-1, 0), at(1, 0)});
      else if (isBetweenRows)
        sides.insert(sides.end(), {at(0, 0), at(0, 1), at(0, -1)});
    }
  }
}

std::vector<std::array<float, 2>> textureCoordinatesOf(const Piece& points) {
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(points.particleCount());
  const auto right = static_cast<float>(points.columns - 1), down = static_cast<float>(points.rows - 1);
  for (int row = 0; row < points.rows; ++row)
    for (int column = 0; column < points.columns; ++column)
      coordinates.push_back({static_cast<float>(column) / right,
                             static_cast<float>(points.rowsGoUp ? points.rows - 1 - row : row) / down});
  return coordinates;
}

}  // namespace

Refinement refineGrid(const Piece& grid, std::uint32_t steps, std::uint32_t firstPoint) {
  const int side = static_cast<int>(steps);
  Piece points;
  points.firstParticle = firstPoint;
  points.columns = side * (grid.columns - 1) + 1;
  points.rows = side * (grid.rows - 1) + 1;
  points.rowsGoUp = grid.rowsGoUp;

  Refinement refinement;
  refinement.grid = points;
  refinement.pointCount = points.particleCount();
  refinement.triangles.reserve(std::size_t{2} * refinement.pointCount);
  // Cell by cell of the grid, so that neighbouring triangles have most points in common.
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
          for (const auto& triangle : points.cellTriangles(side * column + i, side * row + j))
            refinement.triangles.push_back(triangle);
  if (side == 2) appendMiddles(points, refinement);
  refinement.textureCoordinates = textureCoordinatesOf(points);
  return refinement;
}

}  // namespace clothsim
