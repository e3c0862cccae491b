// The only place where time advances. Both backends run the same passes in the same order and agree in every
// bit.
#pragma once

#include <memory>
#include <string>

#include "cloth/cloth.h"
#include "solver/state.h"

namespace clothsim {

class Solver {
 public:
  virtual ~Solver() = default;

  // Live parameters: gravity, wind, damping, colliders, integrator, step length... of `scene`, from the next
  // step on. Changing the integrator converts the velocities by -+ h a / 2. The grids must be those of the
  // solver's cloth.
  virtual void configure(const Scene& scene) = 0;

  // Advances by `count` steps. Neither throws nor allocates; on the GPU nothing is waited for.
  virtual void step(int count) = 0;
  // Waits until every step is done. @throws OpenGlError when the driver has reported an error meanwhile
  virtual void finish() = 0;

  // A blocking copy of the state, and its inverse: together they hand a simulation from one backend to the
  // other.
  [[nodiscard]] virtual State state() = 0;
  virtual void setState(const State& state) = 0;
  [[nodiscard]] virtual std::uint64_t stepIndex() const = 0;

  [[nodiscard]] virtual std::string backend() const = 0;  // "cpu" or "gpu"
  [[nodiscard]] virtual std::string device() const = 0;   // what it runs on, for people
};

// The state at time 0: at rest on the lattice.
[[nodiscard]] State initialState(const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
