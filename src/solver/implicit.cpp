#include "solver/implicit.h"

#include <algorithm>

namespace clothsim {
namespace {

// Points of the next coarser line: every second one, and the last.
std::uint32_t coarsened(std::uint32_t points) { return points > 2 ? points / 2 + 1 : points; }

// Sum of the squares of a hat of so many cells to each side.
double squares(double cells) { return (2 * cells * cells + 1) / (3 * cells); }
// Sum of its squared slopes.
double slopes(double cells) { return 2 / cells; }

template <class Real>
void putFactors(const Grid& grid, double across, double along, LevelParams<Real>& level) {
  const double area = across * along;
  const double x = slopes(across) * squares(along) / area, y = slopes(along) * squares(across) / area;
  const double mean = grid.rows == 1 ? x : grid.columns == 1 ? y : 0.5 * (x + y);
  level.stretchFactor = static_cast<Real>(mean);
  level.inertiaFactor = static_cast<Real>(squares(across) * squares(along) / area);
  // A hat bends at three points: 1 + 4 + 1 over the square of its width.
  level.bending = static_cast<Real>(6 * grid.bendAlongRow * squares(along) / (across * across) +
                                    6 * grid.bendAlongColumn * squares(across) / (along * along));
}

}  // namespace

template <class Real>
Hierarchy<Real> makeHierarchy(const Cloth& cloth) {
  Hierarchy<Real> hierarchy;
  hierarchy.vertices = cloth.particleCount();
  for (const Grid& grid : cloth.grids()) {
    std::vector<LevelParams<Real>>& levels = hierarchy.grids.emplace_back();
    std::uint32_t first = grid.firstParticle, columns = static_cast<std::uint32_t>(grid.columns),
                  rows = static_cast<std::uint32_t>(grid.rows);
    double across = 1, along = 1;  // width of a hat, in cells of the grid
    while (!grid.isMesh && (columns > 2 || rows > 2)) {
      LevelParams<Real> level{};
      level.fineFirst = first;
      level.fineColumns = columns;
      level.fineRows = rows;
      if (columns > 2) across *= 2;
      if (rows > 2) along *= 2;
      level.coarseFirst = first = hierarchy.vertices;
      level.coarseColumns = columns = coarsened(columns);
      level.coarseRows = rows = coarsened(rows);
      hierarchy.vertices += columns * rows;
      putFactors(grid, across, along, level);
      levels.push_back(level);
    }
  }
  return hierarchy;
}

template Hierarchy<float> makeHierarchy(const Cloth&);
template Hierarchy<double> makeHierarchy(const Cloth&);

}  // namespace clothsim
