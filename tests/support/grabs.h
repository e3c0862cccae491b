// Hands for tests: where they hold, blow and cut.
#pragma once

#include <cstdint>

#include "cloth/cuts.h"
#include "solver/interaction.h"
#include "solver/solver.h"

namespace clothsim::test {

inline Vec3f placeOf(const State& state, std::uint32_t particle) {
  const Particle4& x = state.positions[particle];
  return {x.x, x.y, x.z};
}

// Holds a particle and goes to the target in one frame.
inline Interaction grabTo(Solver& solver, const Cloth& cloth, const Scene& scene, std::uint32_t particle,
                          Vec3d target, double strength, double radius = 0) {
  Interaction interaction;
  interaction.grab = makeGrabSpring(
      cloth, particle, strength, radius,
      [&](std::uint32_t first, std::uint32_t count) { return solver.positions(first, count); });
  moveTo(*interaction.grab, target, solver.stepIndex(), scene.solver.simulationSteps);
  return interaction;
}

// The first grid cut in two, from side to side below a row; between two rows.
inline Cuts cutAcross(const Cloth& cloth, double row) {
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {-1, row}, {cloth.pieces()[0].columns + 1.0, row + 1e-3});
  return cuts;
}

// A zigzag that ends within the first grid.
inline Cuts someCuts(const Cloth& cloth) {
  const Piece& piece = cloth.pieces()[0];
  Cuts cuts;
  const double c = piece.columns, r = piece.rows;
  cutAlong(cuts, cloth, 0, {0.1 * c, -1}, {0.4 * c, 0.6 * r});
  cutAlong(cuts, cloth, 0, {0.4 * c, 0.6 * r}, {0.7 * c, 0.2 * r});
  return cuts;
}

// Cuts all springs of the rows below the middle one, and leaves strings of the two rows above.
inline Cuts crumbled(const Cloth& cloth) {
  const Piece& piece = cloth.pieces()[0];
  Cuts cuts(cloth.particleCount());
  for (int row = 0; row < piece.rows / 2 + 2; ++row)  // a particle owns springs to the two rows below it
    for (int column = 0; column < piece.columns; ++column)
      cuts[piece.particle(column, row)] = row < piece.rows / 2 ? 0x3f : 0x3e;
  return cuts;
}

}  // namespace clothsim::test
