// Cuts in a cloth: springs that are gone, and with them the triangles whose sides they were. Strokes run over
// the lattice, so that a cut depends neither on how the cloth lies nor on the camera.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/cloth.h"

namespace clothsim {

// A byte a particle: bit `slot` is set when the spring that it owns in that slot is cut. Empty: nothing is.
using Cuts = std::vector<std::uint8_t>;

inline constexpr std::uint32_t NO_SPRING = 31;  // a bit that no cut mask has

// A place on a grid in units of its cells: grid point (column, row) lies at {column, row}.
struct LatticePoint {
  double column = 0, row = 0;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

// Cuts every spring of the cloth's piece number `grid` that crosses the straight stroke from `from` to `to`,
// whether it is enabled or not. Returns whether there was anything left to cut. May lie off the grid in part.
// Meshes are not cut.
bool cutAlong(Cuts& cuts, const Cloth& cloth, std::size_t piece, LatticePoint from, LatticePoint to);

// Whether the spring of particle `owner` in `slot` is cut.
[[nodiscard]] inline bool isCut(const Cuts& cuts, std::uint32_t owner, SpringSlot slot) {
  return !cuts.empty() && (cuts[owner] >> slot & 1) != 0;
}
// One of Cloth::springs(); those of meshes are not cut.
[[nodiscard]] inline bool isCut(const Cuts& cuts, const Spring& spring) {
  return isCut(cuts, spring.a, static_cast<SpringSlot>(spring.number % SPRING_SLOTS));
}

// Cloth::triangles() without those of which a side is cut, in the same order.
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
