// A state in buffers of its own, copied on the device.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "solver/solver.h"

namespace clothsim {

struct GpuSnapshot final : Snapshot {
  gl::Buffer<Particle4> positions, velocities;
  StepClock clock;
  Integrator velocityMeaning = Integrator::verlet;
  Cuts cuts;  // on the host
  std::vector<std::uint32_t> offPath;

  [[nodiscard]] std::size_t bytes() const override { return positions.bytes() + velocities.bytes(); }
  [[nodiscard]] State state() const override {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    State state;
    state.positions = positions.download();
    state.velocities = velocities.download();
    state.clock = clock;
    state.integrator = velocityMeaning;
    state.cuts = cuts;
    state.offPath = offPath;
    return state;
  }
};

}  // namespace clothsim
