// Cuts in a cloth: springs of grids that are gone, and with them the triangles whose sides they were; of
// meshes triangles that are gone, and with them what they held. Strokes run over the lattice, so that a cut
// depends neither on how the cloth lies nor on the camera.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

// First a byte a particle: bit `slot` is set when the spring of a grid that it owns in that slot is cut.
// Behind them a byte a triangle of Cloth::lists(): 1 when its mesh has lost it. Empty: nothing is cut.
using Cuts = std::vector<std::uint8_t>;
[[nodiscard]] inline std::size_t cutsSize(const Cloth& cloth) {
  return cloth.particleCount() + cloth.lists().triangles.size();
}

inline constexpr std::uint32_t NO_SPRING = 31;  // a bit that no cut mask has

// A place on a grid in units of its cells: grid point (column, row) lies at {column, row}.
struct LatticePoint {
  double column = 0, row = 0;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

// Cuts every spring of the cloth's piece number `piece` that crosses the straight stroke from `from` to `to`,
// whether it is enabled or not. Returns whether there was anything left to cut. May lie off the grid in part.
// Meshes are not cut.
bool cutAlong(Cuts& cuts, const Cloth& cloth, std::size_t piece, LatticePoint from, LatticePoint to);

// Whether the spring of particle `owner` in `slot` is cut.
[[nodiscard]] inline bool isCut(const Cuts& cuts, std::uint32_t owner, SpringSlot slot) {
  return !cuts.empty() && (cuts[owner] >> slot & 1) != 0;
}
// One of Cloth::springs().
[[nodiscard]] bool isCut(const Cuts& cuts, const Cloth& cloth, const Spring& spring);

// What meshes have lost: triangles; edges whose triangles are all lost; and springs and folds across an edge
// with one of its triangles.
[[nodiscard]] bool isLost(const Cuts& cuts, const Cloth& cloth, std::uint32_t triangle);
[[nodiscard]] bool isCut(const Cuts& cuts, const Cloth& cloth, const MeshSpring& spring);
[[nodiscard]] bool isCut(const Cuts& cuts, const Cloth& cloth, const Hinge& hinge);
// Takes the triangles beside an edge of a mesh.
void tearEdge(Cuts& cuts, const Cloth& cloth, const MeshSpring& edge);
// Cloth::lists() where particles gather over what is left; all elements keep their places and numbers.
[[nodiscard]] SpringLists remainingLists(const Cloth& cloth, const Cuts& cuts);
// Whether an edge that is left joins two particles of a mesh.
[[nodiscard]] bool areJoined(const Cuts& cuts, const Cloth& cloth, std::uint32_t i, std::uint32_t j);

// Cloth::triangles() without those of which a side is cut and those that a mesh has lost, in the same order.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> remainingTriangles(const Cloth& cloth,
                                                                           const Cuts& cuts);
// How many those are.
[[nodiscard]] std::uint64_t remainingTriangleCount(const Cloth& cloth, const Cuts& cuts);
// Cloth::springCount() without those that are cut.
[[nodiscard]] std::uint64_t remainingSpringCount(const Cloth& cloth, const Cuts& cuts);

// What the solvers step with: for each particle a number whose bit k says that incidentSprings[k] is cut, and
// bit 12 + k that the particle has lost incidentTriangles[k]; empty for no cuts. (A cut grid could run on
// lists of what is left; looking up one number a particle on the regular grid is faster than any list.)
[[nodiscard]] std::vector<std::uint32_t> makeCutMasks(const Cloth& cloth, const Cuts& cuts);
// Which of incidentSprings joins a grid point to its neighbour in one cell, -1 to 1 columns and rows away.
[[nodiscard]] constexpr std::uint32_t springWithinCell(int columns, int rows) {
  for (std::uint32_t k = 0; k < incidentSprings.size(); ++k)
    if (incidentSprings[k].columns == columns && incidentSprings[k].rows == rows) return k;
  return NO_SPRING;
}

}  // namespace clothsim
