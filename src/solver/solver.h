// The only place where time advances. It holds what a step depends on - scene, clock, interaction, cuts, pins
// - and the list of passes that a step is made of; an executor does them. Both executors agree in every bit.
#pragma once

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "core/shared.h"
#include "solver/divergence.h"
#include "solver/executor.h"
#include "solver/interaction.h"
#include "solver/state.h"

namespace clothsim {

// A state, its particles on the device of a solver. Outlives the solver, on the GPU not the context.
struct Snapshot {
  std::unique_ptr<ParticleCopy> particles;
  StepClock clock;
  Integrator integrator = Integrator::verlet;
  Cuts cuts;
  std::vector<std::uint32_t> offPath;
  bool isSecondOrder = false;             // made between steps of `bdf2`
  std::vector<std::optional<bool>> held;  // of each path of pins, whether it has its particles pinned

  [[nodiscard]] std::size_t bytes() const { return particles->bytes(); }  // of the particles, on the device
  [[nodiscard]] State state() const;                                      // blocking
};

class Solver {
 public:
  // At the start, at rest. `cloth` must outlive the solver.
  Solver(const Cloth& cloth, const Shared<Scene>& scene, std::unique_ptr<Executor> executor);
  virtual ~Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  // Live parameters: gravity, wind, damping, colliders, integrator, step length... of `scene`, from the next
  // step on. The time stays what it is. Changing the integrator converts the velocities by -+ h a / 2. What
  // moves no cloth, such as looks and the camera, changes nothing. The grids must be those of the solver's
  // cloth.
  void configure(const Shared<Scene>& scene);

  // Advances by `count` steps; by fewer once an interrupt has come (core/interrupt.h) or a divergence
  // is known: by the CPU at once, by the GPU after divergence(). On the GPU nothing is waited for, except by
  // cloth that tears, whose positions are read after each frame; where layers may touch, the state is copied
  // on the device, once for all steps until the next question.
  void step(int count);
  // Waits until every step is done. @throws OpenGlError when the driver has reported an error meanwhile
  void finish() { executor_->finish(); }
  // The passes of a step that makes the levels of the preconditioner; the others keep those of the step
  // before.
  [[nodiscard]] const PassList& passes() const { return step_; }
  // Steps, and times every pass, which slows the whole.
  [[nodiscard]] std::vector<PassTime> timePasses(int steps);

  // The first divergence since the solver was made or setState() was called; the same on both backends. Waits
  // for the steps, and looks at a few bytes for each of them. Steps after divergence lead nowhere and look
  // for no contacts, which could take minutes in a heap of broken numbers. Where layers may touch, all other
  // questions and changes wait, too: steps for which the GPU had too little room are made again first.
  [[nodiscard]] std::optional<Divergence> divergence();

  // A copy of the state where it lies, and back to it, which forgets divergence. On its own device nothing is
  // waited for; a snapshot of the other backend's solver for the same number of particles serves as well.
  // `reuse`: a snapshot that is needed no more, whose memory may be taken.
  [[nodiscard]] std::unique_ptr<Snapshot> snapshot(std::unique_ptr<Snapshot> reuse = nullptr);
  void restore(const Snapshot& snapshot);
  // keep() remembers a snapshot, revert() goes back to it.
  void keep() { kept_ = snapshot(std::move(kept_)); }
  void revert() {
    assert(kept_ && "revert() needs a keep() before");
    restore(*kept_);
  }

  // A blocking copy of the state, and its inverse: together they hand a simulation from one backend to the
  // other.
  [[nodiscard]] State state();
  void setState(const State& state);
  // Does at once what the next step or state() would begin with: turns the velocities into those of an
  // integrator that configure() has brought.
  void convertVelocities();
  // Positions of a few particles [first, first + count); a small blocking read-back on the GPU.
  [[nodiscard]] std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count);

  // What an interaction does from the next step on.
  void setInteraction(const Interaction& interaction);
  // Springs that are cut exert no force, are not limited and not watched; triangles that lost a side meet no
  // air. Under robust self-collision particles of one cell become non-adjacent particles once the spring
  // between them is cut: they are kept at their distance at rest, like other pairs that lie near each other
  // then. That is less than D (self_collision.h), so it keeps the two sides of a cut apart in practice, but
  // proves nothing.
  void setCuts(const Cuts& cuts);
  [[nodiscard]] const Cuts& cuts() const { return inputs_.cuts; }
  // Pins a particle where it is now, off any path that the scene has for it; or gives it its mass back. It is
  // at rest after either.
  void setPin(std::uint32_t particle, bool pinned);
  [[nodiscard]] const StepClock& clock() const { return inputs_.clock; }
  [[nodiscard]] std::uint64_t stepIndex() const { return clock().step; }
  // A small blocking read-back on the GPU.
  [[nodiscard]] ContactCounts contactCounts();
  [[nodiscard]] ConvergenceCounts convergenceCounts();
  void forgetContactCounts();  // they begin anew

  [[nodiscard]] std::string backend() const { return executor_->backend(); }  // "cpu" or "gpu"
  [[nodiscard]] std::string device() const { return executor_->device(); }    // what it runs on, for people

 protected:
  [[nodiscard]] Executor& executor() const { return *executor_; }
  [[nodiscard]] const StepInputs& inputs() const { return inputs_; }
  // After a change of the state from outside: it may hold anything.
  void distrustState() { startIsChecked_ = levelsAreMade_ = false; }

 private:
  // Steps that may have to be made again, with more room for pairs (Executor::mayLackRoom()). Settled: they
  // are as they should be.
  struct Stretch {
    std::unique_ptr<Snapshot> start;
    int steps = 0;
    bool isSettled = true;
  };

  void takeScene(const Shared<Scene>& scene);
  void keepStretch();
  void settle();
  void advance(int following);
  void setAllButParticles(const StepClock& clock, Integrator integrator,
                          const std::vector<std::uint32_t>& offPath, const Cuts& cuts);
  [[nodiscard]] bool isSecondOrder() const;
  [[nodiscard]] bool looksBackAt(const StepClock& clock) const;
  void setOffPath(std::vector<std::uint32_t> offPath);
  void makeLists();
  void prepare();
  [[nodiscard]] bool keepsLevels() const { return levelsAreMade_ && stepInFrame() % 2 != 0; }
  [[nodiscard]] const PassList& nextStep();
  [[nodiscard]] std::uint64_t stepInFrame() const;
  void checkStart();
  void leaveHalfStep();
  void holdPins();
  [[nodiscard]] std::vector<std::optional<bool>> heldIn(const State& state) const;
  void tearCloth();

  StepInputs inputs_;
  PassList step_, stepWithKeptLevels_;
  const PassList conversion_ = makeConversion(), startCheck_ = makeStartCheck();
  std::unique_ptr<Executor> executor_;
  std::optional<std::size_t> levels_;      // mostLevels(), once an implicit step needs it
  bool startIsChecked_ = true;             // false once a state was handed in
  bool levelsAreMade_ = false;             // false after a change from outside
  std::vector<std::optional<bool>> held_;  // as Snapshot::held; none: not known
  std::optional<Divergence> divergence_;
  Stretch stretch_;
  std::unique_ptr<Snapshot> kept_;
};

// Every free particle moved by 0 to `distance` [m] along each axis: upwards, so that cloth standing on a
// floor stays above it; at random, and the same for the same seed.
void jitter(State& state, double distance, std::uint32_t seed);

// The state at time 0: at rest on the lattice.
[[nodiscard]] State initialState(const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
