// The only place where time advances. Both backends run the same passes in the same order and agree in every
// bit.
#pragma once

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "solver/hand.h"
#include "solver/state.h"
#include "solver/trouble.h"

namespace clothsim {

// What self-collision had to do since the solver was made.
struct ContactCounts {
  std::uint64_t hashBuilds = 0;
  std::uint64_t guardedSteps = 0;  // in which motion had to be cut short
  std::uint64_t fastSteps = 0;     // in which some particle moved farther than the search reaches

  friend ContactCounts operator+(const ContactCounts& a, const ContactCounts& b) {
    return {a.hashBuilds + b.hashBuilds, a.guardedSteps + b.guardedSteps, a.fastSteps + b.fastSteps};
  }
};

// A state on the device of a solver. Outlives the solver, on the GPU not the context.
class Snapshot {
 public:
  virtual ~Snapshot() = default;
  [[nodiscard]] virtual std::size_t bytes() const = 0;  // on the device
  [[nodiscard]] virtual State state() const = 0;        // blocking
};

class Solver {
 public:
  virtual ~Solver() = default;

  // Live parameters: gravity, wind, damping, colliders, integrator, step length... of `scene`, from the next
  // step on. The time stays what it is. Changing the integrator converts the velocities by -+ h a / 2. The
  // grids must be those of the solver's cloth.
  virtual void configure(const Scene& scene) = 0;

  // Advances by `count` steps; by fewer once an interrupt has come (core/interrupt.h) or, on the CPU, after
  // trouble. Neither throws nor allocates; on the GPU nothing is waited for.
  virtual void step(int count) = 0;
  // Waits until every step is done. @throws OpenGlError when the driver has reported an error meanwhile
  virtual void finish() = 0;

  // The first trouble since the solver was made or setState() was called; the same on both backends. Waits
  // for the steps, and looks at a few bytes for each of them. Steps after trouble lead nowhere and look for
  // no contacts, which could take minutes in a heap of broken numbers.
  [[nodiscard]] virtual std::optional<Trouble> trouble() = 0;

  // A copy of the state where it lies, and back to it, which forgets trouble. On its own device nothing is
  // waited for; a snapshot of the other backend's solver for the same number of particles serves as well.
  // `reuse`: a snapshot that is needed no more, whose memory may be taken.
  [[nodiscard]] virtual std::unique_ptr<Snapshot> snapshot(std::unique_ptr<Snapshot> reuse = nullptr) = 0;
  virtual void restore(const Snapshot& snapshot) = 0;
  // keep() remembers a snapshot, revert() goes back to it.
  void keep() { kept_ = snapshot(std::move(kept_)); }
  void revert() {
    assert(kept_ && "revert() needs a keep() before");
    restore(*kept_);
  }

  // A blocking copy of the state, and its inverse: together they hand a simulation from one backend to the
  // other.
  [[nodiscard]] virtual State state() = 0;
  virtual void setState(const State& state) = 0;
  // Does at once what the next step or state() would begin with: turns the velocities into those of an
  // integrator that configure() has brought.
  virtual void convertVelocities() = 0;
  // Positions of a few particles [first, first + count); a small blocking read-back on the GPU.
  [[nodiscard]] virtual std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) = 0;

  // What a hand does from the next step on.
  virtual void setHand(const Hand& hand) = 0;
  // Springs that are cut exert no force, are not limited and not watched; triangles that lost a side meet no
  // air. Under robust self-collision particles of one cell become strangers once the spring between them is
  // cut: they are kept at their distance at rest, like other pairs that lie near each other then. That is
  // less than D (self_collision.h), so it keeps the two sides of a cut apart in practice, but proves nothing.
  virtual void setCuts(const Cuts& cuts) = 0;
  [[nodiscard]] virtual const Cuts& cuts() const = 0;
  // Pins a particle where it is now, off any path that the scene has for it; or gives it its mass back. It is
  // at rest after either.
  virtual void setPin(std::uint32_t particle, bool pinned) = 0;
  [[nodiscard]] virtual const StepClock& clock() const = 0;
  [[nodiscard]] std::uint64_t stepIndex() const { return clock().step; }
  // A small blocking read-back on the GPU.
  [[nodiscard]] virtual ContactCounts contactCounts() = 0;

  [[nodiscard]] virtual std::string backend() const = 0;  // "cpu" or "gpu"
  [[nodiscard]] virtual std::string device() const = 0;   // what it runs on, for people

 private:
  std::unique_ptr<Snapshot> kept_;
};

// Every free particle moved by 0 to `distance` [m] along each axis: upwards, so that cloth standing on a
// floor stays above it; at random, and the same for the same seed.
void jitter(State& state, double distance, std::uint32_t seed);

// The state at time 0: at rest on the lattice.
[[nodiscard]] State initialState(const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
