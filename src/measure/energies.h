// Energies of a cloth, and what happens at a particle, for plots. Computed on the host in double precision
// from a copy of the state.
#pragma once

#include <cstdint>
#include <span>

#include "cloth/cuts.h"
#include "solver/state.h"

namespace clothsim {

struct Energies {      // [J]
  double kinetic = 0;  // 1/2 m v^2, with the velocities as given: under verlet those of the half step before
  double gravity = 0;  // m g h above where the particles started
  double springs = 0;  // 1/2 k (l - L)^2 over enabled springs that are not cut, and that of membranes
  double maxStrain = 0;  // largest l/L - 1 of those springs; no energy, but found in the same loop
  [[nodiscard]] double total() const { return kinetic + gravity + springs; }
};

// `springs` is cloth.springs(), which callers keep because it is slow.
[[nodiscard]] Energies energies(const Cloth& cloth, std::span<const Spring> springs, const Scene& scene,
                                const Cuts& cuts, const State& state);

// What happens at a particle.
struct ParticleFacts {
  double speed = 0;   // [m/s]
  double strain = 0;  // l/L - 1 of largest magnitude among its springs, with its sign; 0 without springs
  double force = 0;   // k (l - L) of that spring, positive where it pulls [N]; 0 along edges of a membrane
};
[[nodiscard]] ParticleFacts factsOf(std::uint32_t particle, const Cloth& cloth,
                                    std::span<const Spring> springs, const Cuts& cuts, const State& state);

}  // namespace clothsim
