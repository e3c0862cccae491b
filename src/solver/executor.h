// Executes lists of passes on one device, where it keeps the particles. What a step is made of, and what it
// depends on, it is told (solver/solver.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/contact_counts.h"
#include "solver/divergence.h"
#include "solver/state.h"
#include "solver/step_inputs.h"
#include "solver/step_list.h"

namespace clothsim {

// How far implicit steps were solved since the solver was made.
struct ConvergenceCounts {
  std::uint64_t steps = 0;
  // Whose last update, or what its linear system lacked, was above the tolerance.
  std::uint64_t unconvergedSteps = 0;
  std::uint64_t newtonSteps = 0;
  std::uint64_t iterations = 0;        // of conjugate gradients
  double lastUpdate = 0;               // of the last step: over its motion, or a tenth of the spacing
  std::uint64_t secondOrderSteps = 0;  // of `bdf2`; the others were backward Euler

  // Those of one solver and of the one that went on from it.
  friend ConvergenceCounts operator+(const ConvergenceCounts& a, const ConvergenceCounts& b) {
    return {a.steps + b.steps,
            a.unconvergedSteps + b.unconvergedSteps,
            a.newtonSteps + b.newtonSteps,
            a.iterations + b.iterations,
            b.steps > 0 ? b.lastUpdate : a.lastUpdate,
            a.secondOrderSteps + b.secondOrderSteps};
  }
  // What has happened since `b`.
  friend ConvergenceCounts operator-(const ConvergenceCounts& a, const ConvergenceCounts& b) {
    return {a.steps - b.steps,
            a.unconvergedSteps - b.unconvergedSteps,
            a.newtonSteps - b.newtonSteps,
            a.iterations - b.iterations,
            a.lastUpdate,
            a.secondOrderSteps - b.secondOrderSteps};
  }
};

struct PassTime {
  std::string name;    // of the pass, or of those that were done in one sweep or dispatch
  double seconds = 0;  // all of them together
};

// Adds to the time of that name, or appends it.
void addTime(std::vector<PassTime>& times, const std::string& name, double seconds);

// Positions, velocities and inverse masses on a device. Outlives the executor, on the GPU not the
// context.
class ParticleCopy {
 public:
  virtual ~ParticleCopy() = default;
  [[nodiscard]] virtual std::size_t bytes() const = 0;  // on the device
  virtual void download(State& state) const = 0;        // its positions and velocities; blocking
  // Whether only the thread that has the context may free it.
  [[nodiscard]] virtual bool needsContext() const { return false; }
};

class Executor {
 public:
  virtual ~Executor() = default;

  // Allocates and compiles what the lists need with these inputs: at the start, and after every change of the
  // inputs but the clock. `list` is that of the steps; conversion and start check are always at hand.
  virtual void prepare(const StepInputs& inputs, const PassList& list) = 0;
  // The scene, or the cuts, are other ones; prepare() follows.
  virtual void setScene(const StepInputs& inputs) = 0;
  virtual void setCuts(const StepInputs& inputs) = 0;

  // Executes a list that belongs to the next step. `steps`: how many steps may follow with these inputs, this
  // one included, so that their parameters may be made at once. Neither throws nor allocates; on the GPU
  // nothing is waited for.
  virtual void run(const StepInputs& inputs, const PassList& list, int steps) = 0;
  // After the last list for now: others may look at the particles.
  virtual void flush() = 0;
  // Waits until every list is done. @throws OpenGlError when the driver has reported an error meanwhile
  virtual void finish() = 0;

  // What a state knows of particles, and back; blocking. What was known of contacts is forgotten.
  virtual void upload(const State& state) = 0;
  virtual void download(State& state) = 0;
  [[nodiscard]] virtual std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) = 0;
  // 0 [1/kg]: pinned. The particle is at rest then, or keeps its velocity.
  virtual void setInverseMass(std::uint32_t particle, double inverseMass, bool rests) = 0;
  // A copy on the device, in the memory of `reuse` where it fits, and back. False for another device's copy.
  [[nodiscard]] virtual std::unique_ptr<ParticleCopy> copy(std::unique_ptr<ParticleCopy> reuse) = 0;
  [[nodiscard]] virtual bool restore(const ParticleCopy& copy) = 0;

  // The next step looks back at none before it.
  virtual void forgetHistory() = 0;

  // What the watchdog has found up to the step after `step` steps. With `wait` false only what is known
  // without waiting for the device.
  [[nodiscard]] virtual std::optional<Divergence> findDivergence(std::uint64_t step, bool wait) = 0;
  // On the GPU, steps may find more pairs that touch than there is room for. They are made again then, with
  // more room: whether that may be; to keep what has been counted, and to go back to that; and, after
  // findDivergence() has waited, whether steps since then have lacked room that there is now.
  [[nodiscard]] virtual bool mayLackRoom() const { return false; }
  virtual void keepCounts() {}
  virtual void restoreCounts() {}
  [[nodiscard]] virtual bool lackedRoom() { return false; }
  // From the step after `step` steps on, everything counts as sound.
  virtual void forgetDivergence(std::uint64_t step) = 0;
  // A small blocking read-back on the GPU.
  [[nodiscard]] virtual ContactCounts contactCounts() = 0;
  [[nodiscard]] virtual ConvergenceCounts convergenceCounts() = 0;  // the same
  virtual void forgetContactCounts() = 0;                           // they begin anew

  // Between these, passes are timed (which slows the whole), and times add up by name.
  virtual void startTiming() = 0;
  [[nodiscard]] virtual std::vector<PassTime> stopTiming() = 0;

  [[nodiscard]] virtual std::string backend() const = 0;  // "cpu" or "gpu"
  [[nodiscard]] virtual std::string device() const = 0;   // what it runs on, for people
};

}  // namespace clothsim
