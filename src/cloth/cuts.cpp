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

bool cutAlong(Cuts& cuts, const Cloth& cloth, std::size_t piece, LatticePoint from, LatticePoint to) {
  const Piece& g = cloth.pieces()[piece];
  const Extent columns = extentOf(from.column, to.column, g.columns);
  const Extent rows = extentOf(from.row, to.row, g.rows);
  bool any = false;
  if (g.isMesh) return any;
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
CellTriangles trianglesLeft(const Piece& piece, const Cuts& cuts, int column, int row) {
  const std::uint32_t b = piece.particle(column + 1, row), c = piece.particle(column, row + 1),
                      d = piece.particle(column + 1, row + 1);
  const bool diagonal = !isCut(cuts, c, toUpperRight);  // a side of both
  return {diagonal && !isCut(cuts, c, toUpper) && !isCut(cuts, b, toLeft),
          diagonal && !isCut(cuts, d, toLeft) && !isCut(cuts, d, toUpper)};
}

// The place in incidentSprings of a slot as its other end sees it.
std::size_t seenFromOtherEnd(int slot) {
  return static_cast<std::size_t>(
      std::find_if(incidentSprings.begin(), incidentSprings.end(),
                   [&](const IncidentSpring& spring) { return !spring.owned && spring.slot == slot; }) -
      incidentSprings.begin());
}

class CutMasks {
 public:
  CutMasks(const Piece& piece, const Cuts& cuts, std::vector<std::uint32_t>& masks)
      : piece_(piece), cuts_(cuts), masks_(masks) {}

  // The springs that a grid point owns, for both ends.
  void addSprings(int column, int row) {
    const std::uint32_t owner = piece_.particle(column, row);
    for (int slot = 0; slot < SPRING_SLOTS; ++slot) {
      if (!isCut(cuts_, owner, static_cast<SpringSlot>(slot))) continue;
      const SpringOffset& offset = springOffsets[static_cast<std::size_t>(slot)];
      if (!piece_.contains(column + offset.columns, row + offset.rows)) continue;
      masks_[owner] |= 1u << slot;
      masks_[piece_.particle(column + offset.columns, row + offset.rows)] |= 1u << seenFromOtherEnd(slot);
    }
  }
  // The triangles of a cell, for their corners, which know them by their place in incidentTriangles.
  void addTriangles(int column, int row) {
    if (column < 0 || row < 0 || column + 1 >= piece_.columns || row + 1 >= piece_.rows) return;
    const CellTriangles left = trianglesLeft(piece_, cuts_, column, row);
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

 private:
  void lose(int column, int row, std::uint32_t k) {
    masks_[piece_.particle(column, row)] |= 1u << (incidentSprings.size() + k);
  }

  const Piece& piece_;
  const Cuts& cuts_;
  std::vector<std::uint32_t>& masks_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> remainingTriangles(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty()) return cloth.triangles();
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto& listed = cloth.lists().triangles;
  for (const Piece& piece : cloth.pieces()) {
    if (piece.isMesh)
      triangles.insert(triangles.end(), listed.begin() + piece.firstTriangle,
                       listed.begin() + piece.endTriangle);
    for (int row = 0; row + 1 < piece.rows; ++row) {
      for (int column = 0; column + 1 < piece.columns; ++column) {
        const auto [first, second] = piece.cellTriangles(column, row);
        const CellTriangles left = trianglesLeft(piece, cuts, column, row);
        if (left.first) triangles.push_back(first);
        if (left.second) triangles.push_back(second);
      }
    }
  }
  return triangles;
}

std::uint64_t remainingTriangleCount(const Cloth& cloth, const Cuts& cuts) {
  return cuts.empty() ? cloth.triangleCount() : remainingTriangles(cloth, cuts).size();
}

std::uint64_t remainingSpringCount(const Cloth& cloth, const Cuts& cuts) {
  std::uint64_t count = cloth.springCount();
  if (cuts.empty()) return count;
  for (const Piece& piece : cloth.pieces())
    for (std::uint32_t i = 0; i < piece.particleCount(); ++i)
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
        if (piece.slotEnabled[slot] && isCut(cuts, piece.firstParticle + i, static_cast<SpringSlot>(slot)))
          --count;
  return count;
}

std::vector<std::uint32_t> makeCutMasks(const Cloth& cloth, const Cuts& cuts) {
  if (cuts.empty()) return {};
  std::vector<std::uint32_t> masks(cloth.particleCount());
  for (const Piece& piece : cloth.pieces()) {
    CutMasks ofPiece(piece, cuts, masks);
    for (int row = 0; row < piece.rows; ++row) {
      for (int column = 0; column < piece.columns; ++column) {
        if (cuts[piece.particle(column, row)] == 0) continue;
        ofPiece.addSprings(column, row);
        // Sides that the point owns belong to triangles of the four cells around it.
        for (const int cellRow : {row - 1, row})
          for (const int cellColumn : {column - 1, column}) ofPiece.addTriangles(cellColumn, cellRow);
      }
    }
  }
  return masks;
}

}  // namespace clothsim
