#include "cloth/cuts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace clothsim {
namespace {

// Above 0 on one side of the line from `a` to `b`, below 0 on the other.
double sideOf(LatticePoint a, LatticePoint b, LatticePoint point) {
  return (b.column - a.column) * (point.row - a.row) - (b.row - a.row) * (point.column - a.column);
}

// Whether the stroke from `a` to `b` cuts the spring from `p` to `q`. A grid point on the stroke belongs to
// one side of it, so that a stroke through it misses no spring that passes it; a stroke that ends on a spring
// cuts it.
bool cross(LatticePoint a, LatticePoint b, LatticePoint p, LatticePoint q) {
  const double sideOfA = sideOf(p, q, a), sideOfB = sideOf(p, q, b);
  return (sideOf(a, b, p) >= 0) != (sideOf(a, b, q) >= 0) && !(sideOfA > 0 && sideOfB > 0) &&
         !(sideOfA < 0 && sideOfB < 0);
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
        cuts.resize(cutsSize(cloth));
        cuts[owner] = static_cast<std::uint8_t>(cuts[owner] | 1u << slot);
        any = true;
      }
    }
  }
  return any;
}

bool isCut(const Cuts& cuts, const Cloth& cloth, const Spring& spring) {
  const std::uint32_t ofGrids = SPRING_SLOTS * cloth.particleCount();
  if (spring.number < ofGrids)
    return isCut(cuts, spring.a, static_cast<SpringSlot>(spring.number % SPRING_SLOTS));
  return isCut(cuts, cloth, cloth.lists().springs[spring.number - ofGrids]);
}

bool isLost(const Cuts& cuts, const Cloth& cloth, std::uint32_t triangle) {
  const std::size_t place = std::size_t{cloth.particleCount()} + triangle;
  return place < cuts.size() && cuts[place] != 0;
}

bool isCut(const Cuts& cuts, const Cloth& cloth, const MeshSpring& spring) {
  const bool first = isLost(cuts, cloth, spring.triangles[0]),
             second = isLost(cuts, cloth, spring.triangles[1]);
  return spring.kind == SpringKind::structural ? first && second : first || second;
}

bool isCut(const Cuts& cuts, const Cloth& cloth, const Hinge& hinge) {
  return isLost(cuts, cloth, hinge.triangles[0]) || isLost(cuts, cloth, hinge.triangles[1]);
}

void tearEdge(Cuts& cuts, const Cloth& cloth, const MeshSpring& edge) {
  cuts.resize(cutsSize(cloth));
  for (const std::uint32_t triangle : edge.triangles) cuts[cloth.particleCount() + triangle] = 1;
}

namespace {

// `isGone(entry)`: whether a particle no longer gathers over it.
template <class IsGone>
void leaveOut(SpringLists::Incidence& incidence, IsGone isGone) {
  SpringLists::Incidence left;
  for (std::size_t i = 0; i + 1 < incidence.starts.size(); ++i) {
    left.starts.push_back(static_cast<std::uint32_t>(left.entries.size()));
    for (std::uint32_t at = incidence.starts[i]; at < incidence.starts[i + 1]; ++at)
      if (!isGone(incidence.entries[at])) left.entries.push_back(incidence.entries[at]);
  }
  left.starts.push_back(static_cast<std::uint32_t>(left.entries.size()));
  incidence = std::move(left);
}

}  // namespace

SpringLists remainingLists(const Cloth& cloth, const Cuts& cuts) {
  SpringLists lists = cloth.lists();
  if (lists.empty() || cuts.empty()) return lists;
  leaveOut(lists.springsOf, [&](std::uint32_t entry) { return isCut(cuts, cloth, lists.springs[entry]); });
  leaveOut(lists.hingesOf, [&](std::uint32_t entry) { return isCut(cuts, cloth, lists.hinges[entry / 4]); });
  leaveOut(lists.trianglesOf, [&](std::uint32_t entry) { return isLost(cuts, cloth, entry); });
  leaveOut(lists.membranesOf,
           [&](std::uint32_t entry) { return isLost(cuts, cloth, lists.membranes[entry / 4].triangle); });
  return lists;
}

bool areJoined(const Cuts& cuts, const Cloth& cloth, std::uint32_t i, std::uint32_t j) {
  const std::optional<std::uint32_t> spring = cloth.lists().edgeBetween(i, j);
  return spring && !isCut(cuts, cloth, cloth.lists().springs[*spring]);
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
    for (std::uint32_t t = piece.firstTriangle; t < piece.endTriangle; ++t)
      if (!isLost(cuts, cloth, t)) triangles.push_back(listed[t]);
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
  for (const MeshSpring& spring : cloth.lists().springs) count -= isCut(cuts, cloth, spring) ? 1 : 0;
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
