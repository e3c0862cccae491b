#include "cloth/cuts.h"

#include <algorithm>
#include <cmath>

namespace clothsim {
namespace {

// Which side of the line from `a` to `b` the point is on. What lies on the line belongs to one side, so a
// stroke through a grid point misses no spring that passes it.
bool isLeftOf(LatticePoint a, LatticePoint b, LatticePoint point) {
  return (b.column - a.column) * (point.row - a.row) - (b.row - a.row) * (point.column - a.column) >= 0;
}

bool cross(LatticePoint a, LatticePoint b, LatticePoint p, LatticePoint q) {
  return isLeftOf(a, b, p) != isLeftOf(a, b, q) && isLeftOf(p, q, a) != isLeftOf(p, q, b);
}

struct Extent {  // of grid points that may own a spring across the stroke
  int low, high;
};
Extent extentOf(double a, double b, int points) {
  constexpr double longestSpring = 2;
  const double last = points - 1;
  return {static_cast<int>(std::clamp(std::floor(std::min(a, b) - longestSpring), 0.0, last)),
          static_cast<int>(std::clamp(std::ceil(std::max(a, b) + longestSpring), 0.0, last))};
}

}  // namespace

bool cutAlong(Cuts& cuts, const Cloth& cloth, std::size_t grid, LatticePoint from, LatticePoint to) {
  const Grid& g = cloth.grids()[grid];
  const Extent columns = extentOf(from.column, to.column, g.columns);
  const Extent rows = extentOf(from.row, to.row, g.rows);
  bool any = false;
  for (int row = rows.low; row <= rows.high; ++row) {
    for (int column = columns.low; column <= columns.high; ++column) {
      for (int slot = 0; slot < SPRING_SLOTS; ++slot) {
        const SpringOffset& offset = springOffsets[static_cast<std::size_t>(slot)];
        const int otherColumn = column + offset.columns, otherRow = row + offset.rows;
        if (!g.contains(otherColumn, otherRow)) continue;
        const std::uint32_t owner = g.particle(column, row);
        if (isCut(cuts, owner, static_cast<SpringSlot>(slot))) continue;
        if (!cross(from, to, {double(column), double(row)}, {double(otherColumn), double(otherRow)}))
          continue;
        cuts.resize(cloth.particleCount());
        cuts[owner] = static_cast<std::uint8_t>(cuts[owner] | 1u << slot);
        any = true;
      }
    }
  }
  return any;
}

std::vector<std::array<std::uint32_t, 3>> remainingTriangles(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty()) return cloth.triangles();
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Grid& grid : cloth.grids()) {
    for (int row = 0; row + 1 < grid.rows; ++row) {
      for (int column = 0; column + 1 < grid.columns; ++column) {
        const std::uint32_t a = grid.particle(column, row), b = grid.particle(column + 1, row);
        const std::uint32_t c = grid.particle(column, row + 1), d = grid.particle(column + 1, row + 1);
        if (isCut(cuts, c, toUpperRight)) continue;  // the diagonal, a side of both
        if (!isCut(cuts, c, toUpper) && !isCut(cuts, b, toLeft)) triangles.push_back({a, c, b});
        if (!isCut(cuts, d, toLeft) && !isCut(cuts, d, toUpper)) triangles.push_back({b, c, d});
      }
    }
  }
  return triangles;
}

}  // namespace clothsim
