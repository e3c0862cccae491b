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

// A place on a grid in units of its cells: grid point (column, row) lies at {column, row}.
struct LatticePoint {
  double column = 0, row = 0;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

// Cuts every spring of the cloth's grid number `grid` that crosses the straight stroke from `from` to `to`,
// whether it is enabled or not. Returns whether there was anything left to cut. May lie off the grid in part.
bool cutAlong(Cuts& cuts, const Cloth& cloth, std::size_t grid, LatticePoint from, LatticePoint to);

// Whether the spring of particle `owner` in `slot` is cut.
[[nodiscard]] inline bool isCut(const Cuts& cuts, std::uint32_t owner, SpringSlot slot) {
  return !cuts.empty() && (cuts[owner] >> slot & 1) != 0;
}

// Cloth::triangles() without those of which a side is cut, in the same order.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> remainingTriangles(const Cloth& cloth,
                                                                           const Cuts& cuts);

}  // namespace clothsim
