// A state in the memory of the CPU backend.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/cpu/cpu_state.h"
#include "solver/solver.h"

namespace clothsim {

template <class Real>
struct CpuSnapshot final : Snapshot {
  CpuState<Real> particles;
  std::vector<Real> inverseMasses;
  std::vector<Real> support;
  StepClock clock;
  Integrator velocityMeaning = Integrator::verlet;
  Cuts cuts;
  std::vector<std::uint32_t> offPath;

  [[nodiscard]] std::size_t bytes() const override {
    return 8 * inverseMasses.size() * sizeof(Real) + cuts.size() + offPath.size() * sizeof(std::uint32_t);
  }
  [[nodiscard]] State state() const override {
    State state;
    const std::size_t count = inverseMasses.size();
    state.positions.resize(count);
    state.velocities.resize(count);
    const auto& [x, v] = particles;
    const auto real = [](Real number) { return static_cast<float>(number); };
    for (std::size_t i = 0; i < count; ++i) {
      state.positions[i] = {real(x.x[i]), real(x.y[i]), real(x.z[i]), real(inverseMasses[i])};
      state.velocities[i] = {real(v.x[i]), real(v.y[i]), real(v.z[i]), real(support[i])};
    }
    state.clock = clock;
    state.integrator = velocityMeaning;
    state.cuts = cuts;
    state.offPath = offPath;
    return state;
  }
};

}  // namespace clothsim
