// The only place where time advances. Both backends run the same passes in the same order and agree in every
// bit.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cloth/cloth.h"
#include "solver/state.h"
#include "solver/trouble.h"

namespace clothsim {

// What self-collision had to do since the state was set.
struct ContactCounts {
  std::uint64_t hashBuilds = 0;
  std::uint64_t guardedSteps = 0;  // in which motion had to be cut short
  std::uint64_t fastSteps = 0;     // in which some particle moved farther than the search reaches
};

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

  // The first trouble since the solver was made or setState() was called; the same on both backends. Waits
  // for the steps, and looks at a few bytes for each of them. Steps go on after trouble, to nowhere.
  [[nodiscard]] virtual std::optional<Trouble> trouble() = 0;

  // keep() remembers the state on the device; revert() goes back to it, and forgets trouble. Neither waits.
  virtual void keep() = 0;
  virtual void revert() = 0;

  // A blocking copy of the state, and its inverse: together they hand a simulation from one backend to the
  // other.
  [[nodiscard]] virtual State state() = 0;
  virtual void setState(const State& state) = 0;
  // Pins a particle where it is now, off any path that the scene has for it; or gives it its mass back. It is
  // at rest after either.
  virtual void setPin(std::uint32_t particle, bool pinned) = 0;
  [[nodiscard]] virtual std::uint64_t stepIndex() const = 0;
  // A small blocking read-back on the GPU.
  [[nodiscard]] virtual ContactCounts contactCounts() = 0;

  [[nodiscard]] virtual std::string backend() const = 0;  // "cpu" or "gpu"
  [[nodiscard]] virtual std::string device() const = 0;   // what it runs on, for people
};

// Every free particle moved by 0 to `distance` [m] along each axis: upwards, so that cloth standing on a
// floor stays above it; at random, and the same for the same seed.
void jitter(State& state, double distance, std::uint32_t seed);

// The state at time 0: at rest on the lattice.
[[nodiscard]] State initialState(const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
