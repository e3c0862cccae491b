// Where the energy of a cloth is, and how far it is stretched at one place: numbers to plot, computed on the
// host in double from a read-back.
#pragma once

#include <cstdint>
#include <span>

#include "cloth/cuts.h"
#include "solver/state.h"

namespace clothsim {

struct Energies {      // [J]
  double kinetic = 0;  // 1/2 m v^2, from the velocities as given: under verlet those of the half step before
  double gravity = 0;  // m g h above where the particles started
  double springs = 0;  // 1/2 k (l - L)^2 over enabled springs that are not cut
  double maxStrain = 0;  // largest l/L - 1 of those springs; no energy, but found on the same way
  [[nodiscard]] double total() const { return kinetic + gravity + springs; }
};

// `springs` are those of cloth.springs(), which takes a while to make.
[[nodiscard]] Energies energies(const Cloth& cloth, std::span<const Spring> springs, const Scene& scene,
                                const Cuts& cuts, const State& state);

// The l/L - 1 of largest size among the springs at a particle, with its sign; 0 without any.
[[nodiscard]] double strainAt(const Cloth& cloth, const Cuts& cuts, const State& state,
                              std::uint32_t particle);

}  // namespace clothsim
