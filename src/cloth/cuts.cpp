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

namespace {

// Which of the two triangles (A, C, B), (B, C, D) of the cell whose upper left point this is are left.
struct CellTriangles {
  bool first, second;
};
CellTriangles trianglesLeft(const Grid& grid, const Cuts& cuts, int column, int row) {
  const std::uint32_t b = grid.particle(column + 1, row), c = grid.particle(column, row + 1),
                      d = grid.particle(column + 1, row + 1);
  const bool diagonal = !isCut(cuts, c, toUpperRight);  // a side of both
  return {diagonal && !isCut(cuts, c, toUpper) && !isCut(cuts, b, toLeft),
          diagonal && !isCut(cuts, d, toLeft) && !isCut(cuts, d, toUpper)};
}

// Bit k: incidentSprings[k] of this grid point is cut.
std::uint32_t cutSprings(const Grid& grid, const Cuts& cuts, int column, int row) {
  std::uint32_t mask = 0;
  for (std::size_t k = 0; k < incidentSprings.size(); ++k) {
    const IncidentSpring& spring = incidentSprings[k];
    if (!grid.contains(column + spring.columns, row + spring.rows)) continue;
    const std::uint32_t owner =
        spring.owned ? grid.particle(column, row) : grid.particle(column + spring.columns, row + spring.rows);
    if (isCut(cuts, owner, spring.slot)) mask |= 1u << k;
  }
  return mask;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> remainingTriangles(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty()) return cloth.triangles();
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Grid& grid : cloth.grids()) {
    for (int row = 0; row + 1 < grid.rows; ++row) {
      for (int column = 0; column + 1 < grid.columns; ++column) {
        const std::uint32_t a = grid.particle(column, row), b = grid.particle(column + 1, row);
        const std::uint32_t c = grid.particle(column, row + 1), d = grid.particle(column + 1, row + 1);
        const CellTriangles left = trianglesLeft(grid, cuts, column, row);
        if (left.first) triangles.push_back({a, c, b});
        if (left.second) triangles.push_back({b, c, d});
      }
    }
  }
  return triangles;
}

std::uint64_t remainingSpringCount(const Cloth& cloth, const Cuts& cuts) {
  std::uint64_t count = cloth.springCount();
  if (cuts.empty()) return count;
  for (const Grid& grid : cloth.grids())
    for (std::uint32_t i = 0; i < grid.particleCount(); ++i)
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
        if (grid.slotEnabled[slot] && isCut(cuts, grid.firstParticle + i, static_cast<SpringSlot>(slot)))
          --count;
  return count;
}

std::vector<std::uint32_t> makeCutMasks(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty()) return {};
  std::vector<std::uint32_t> masks(cloth.particleCount());
  for (const Grid& grid : cloth.grids()) {
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        masks[grid.particle(column, row)] |= cutSprings(grid, cuts, column, row);
    // The corners of a lost triangle know it by its place around them.
    const auto lose = [&](int column, int row, std::uint32_t k) {
      masks[grid.particle(column, row)] |= 1u << (incidentSprings.size() + k);
    };
    for (int row = 0; row + 1 < grid.rows; ++row) {
      for (int column = 0; column + 1 < grid.columns; ++column) {
        const CellTriangles left = trianglesLeft(grid, cuts, column, row);
        if (!left.first) {
          lose(column, row, 5);
          lose(column + 1, row, 3);
          lose(column, row + 1, 1);
        }
        if (!left.second) {
          lose(column + 1, row, 4);
          lose(column, row + 1, 2);
          lose(column + 1, row + 1, 0);
        }
      }
    }
  }
  return masks;
}

}  // namespace clothsim
