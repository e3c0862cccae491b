#include "solver/solver.h"

#include "core/exact_math.h"
#include "core/hash.h"
#include "core/interrupt.h"
#include "solver/step_params.h"
#include "solver/tearing.h"

namespace clothsim {

State Snapshot::state() const {
  State state;
  particles->download(state);
  if (!isSecondOrder) forgetHistory(state);
  state.clock = clock;
  state.integrator = integrator;
  state.cuts = cuts;
  state.offPath = offPath;
  return state;
}

Solver::Solver(const Cloth& cloth, const Shared<Scene>& scene, std::unique_ptr<Executor> executor)
    : executor_(std::move(executor)) {
  inputs_.cloth = &cloth;
  inputs_.velocityMeaning = startingVelocityMeaning(*scene);
  executor_->forgetDivergence(0);
  takeScene(scene);
}

namespace {

// Whether they differ at most in how they look.
bool movesAlike(const Scene& a, Scene b) {
  b.name = a.name;
  b.description = a.description;
  b.camera = a.camera;
  b.render = a.render;
  b.expect = a.expect;
  for (std::size_t i = 0; i < std::min(a.cloths.size(), b.cloths.size()); ++i)
    b.cloths[i].render = a.cloths[i].render;
  for (std::size_t i = 0; i < std::min(a.colliders.size(), b.colliders.size()); ++i)
    std::visit([](const auto& own, auto& other) { other.render = own.render; }, a.colliders[i],
               b.colliders[i]);
  return a == b;
}

}  // namespace

void Solver::configure(const Shared<Scene>& scene) {
  assert(scene->cloths.size() == inputs_.cloth->pieces().size() &&
         "configure() takes live edits of the solver's own scene");
  settle();
  if (movesAlike(*inputs_.scene, *scene))
    inputs_.scene = scene;
  else
    takeScene(scene);
}

void Solver::takeScene(const Shared<Scene>& scene) {
  if (stepLength(scene->solver) != inputs_.clock.stepLength) leaveHalfStep();
  inputs_.colliders = ColliderSet(*scene);
  inputs_.scene = scene;
  inputs_.clock.setStepLength(stepLength(inputs_.scene->solver));
  makeLists();
  executor_->setScene(inputs_);
  setOffPath(inputs_.offPath);
}

void Solver::makeLists() {
  if (!levels_ && isImplicit(inputs_.scene->solver.integrator))
    levels_ = mostLevels(*inputs_.cloth, inputs_.cuts);
  step_ = makeStep(*inputs_.scene, *inputs_.cloth, levels_.value_or(0));
  stepWithKeptLevels_ = keepingLevels(step_);
}

// What the second list needs, the first one does, too.
void Solver::prepare() {
  executor_->prepare(inputs_, step_);
  levelsAreMade_ = false;
}

void Solver::setOffPath(std::vector<std::uint32_t> offPath) {
  inputs_.offPath = std::move(offPath);
  inputs_.pinPaths = makePinPaths(*inputs_.scene, *inputs_.cloth, inputs_.offPath);
  prepare();
}

// Takes hold of pins and lets them go, where that begins or ends with the next step.
void Solver::holdPins() {
  const PinPaths& pins = inputs_.pinPaths;
  held_.resize(pins.paths.size());
  for (std::size_t path = 0; path < pins.paths.size(); ++path) {
    if (pins.paths[path].isFree.empty() && !pins.paths[path].release) continue;
    const bool wanted = isHeld(pins.paths[path], inputs_.clock.time());
    if (std::exchange(held_[path], wanted) == wanted) continue;
    for (std::uint32_t i = 0; i < pins.numbers.size(); ++i)
      if (pins.numbers[i] == path + 1)
        executor_->setInverseMass(i, wanted ? 0 : 1 / inputs_.cloth->massOf(i), false);
  }
}

// Taking hold of pins that the state holds already would end what `bdf2` looks back at.
std::vector<std::optional<bool>> Solver::heldIn(const State& state) const {
  const PinPaths& pins = inputs_.pinPaths;
  std::vector<bool> holdsSome(pins.paths.size()), leavesSome(pins.paths.size());
  for (std::uint32_t i = 0; i < pins.numbers.size(); ++i)
    if (pins.numbers[i] != 0)
      (state.positions[i].w == 0 ? holdsSome : leavesSome)[pins.numbers[i] - 1] = true;
  std::vector<std::optional<bool>> held(pins.paths.size());
  for (std::size_t path = 0; path < held.size(); ++path)
    if (holdsSome[path] != leavesSome[path]) held[path] = holdsSome[path];
  return held;
}

void Solver::checkStart() {
  if (startIsChecked_) return;
  startIsChecked_ = true;
  executor_->run(inputs_, startCheck_, 1);
}

// verlet carries v(n - 1/2), euler v(n): the difference is h a / 2.
void Solver::convertVelocities() {
  const Integrator wanted = velocityMeaningOf(inputs_.scene->solver.integrator);
  if (wanted == inputs_.velocityMeaning) return;
  checkStart();
  inputs_.velocityMeaning = wanted;
  executor_->run(inputs_, conversion_, 1);
}

// What verlet's velocity means depends on the length of the last step, which the clock has. At the start it
// is what the scene begins with.
void Solver::leaveHalfStep() {
  const double last = inputs_.clock.stepLength;
  if (inputs_.clock.step == 0 || last == 0 || inputs_.velocityMeaning != Integrator::verlet) return;
  const Shared<Scene> own = inputs_.scene;
  Scene scene = *own;
  scene.solver.integrator = Integrator::euler;
  scene.solver.framesPerSec = 1 / last;
  scene.solver.simulationSteps.count = 1;
  inputs_.scene = Shared<Scene>(std::move(scene));
  convertVelocities();
  inputs_.scene = own;
}

std::uint64_t Solver::stepInFrame() const {
  const auto stepsPerFrame = static_cast<std::uint64_t>(inputs_.scene->solver.simulationSteps);
  return (inputs_.clock.step - inputs_.clock.originStep) % stepsPerFrame;
}

// The levels are made in every second step of a frame. A frame begins with new ones, so that it does not
// matter whether it is the first after a state was loaded.
const PassList& Solver::nextStep() {
  const PassList& step = keepsLevels() ? stepWithKeptLevels_ : step_;
  levelsAreMade_ = true;
  return step;
}

// At the end of a frame.
void Solver::tearCloth() {
  if (!canTear(*inputs_.scene) || divergence_ || stepInFrame() != 0) return;
  settle();
  Cuts cuts = inputs_.cuts;
  if (tear(cuts, *inputs_.cloth, *inputs_.scene, positions(0, inputs_.cloth->particleCount()))) setCuts(cuts);
}

void Solver::step(int count) {
  checkStart();
  convertVelocities();
  for (int i = 0; i < count && !divergence_ && !isInterrupted(); ++i) {
    keepStretch();
    advance(count - i);
  }
  executor_->flush();
}

void Solver::advance(int following) {
  holdPins();
  executor_->run(inputs_, nextStep(), following);
  ++inputs_.clock.step;
  divergence_ = executor_->findDivergence(inputs_.clock.step, false);
  tearCloth();
}

// A stretch begins where a step makes the levels of the preconditioner: with those of another step, the next
// one would not be the same again.
void Solver::keepStretch() {
  if (!executor_->mayLackRoom()) return;
  if (stretch_.isSettled && !keepsLevels()) {
    stretch_.start = snapshot(std::move(stretch_.start));
    stretch_.steps = 0;
    executor_->keepCounts();
  }
  ++stretch_.steps;
  stretch_.isSettled = false;
}

void Solver::settle() {
  while (!stretch_.isSettled) {
    divergence_ = executor_->findDivergence(inputs_.clock.step + 1, true);
    stretch_.isSettled = true;
    if (!executor_->lackedRoom()) return;
    restore(*stretch_.start);
    executor_->restoreCounts();
    step(stretch_.steps);
  }
}

std::vector<PassTime> Solver::timePasses(int steps) {
  executor_->startTiming();
  step(steps);
  return executor_->stopTiming();
}

std::optional<Divergence> Solver::divergence() {
  settle();
  // A conversion belongs to the step that follows it.
  if (!divergence_) divergence_ = executor_->findDivergence(inputs_.clock.step + 1, true);
  return divergence_;
}

std::unique_ptr<Snapshot> Solver::snapshot(std::unique_ptr<Snapshot> reuse) {
  settle();
  if (!reuse) reuse = std::make_unique<Snapshot>();
  reuse->particles = executor_->copy(std::move(reuse->particles));
  reuse->clock = inputs_.clock;
  reuse->integrator = inputs_.velocityMeaning;
  reuse->cuts = inputs_.cuts;
  reuse->offPath = inputs_.offPath;
  reuse->isSecondOrder = isSecondOrder();
  reuse->held = held_;
  return reuse;
}

void Solver::restore(const Snapshot& snapshot) {
  stretch_.isSettled = true;
  setAllButParticles(snapshot.clock, snapshot.integrator, snapshot.offPath, snapshot.cuts);
  if (!executor_->restore(*snapshot.particles)) return setState(snapshot.state());
  if (snapshot.held.size() == inputs_.pinPaths.paths.size()) held_ = snapshot.held;
  if (!snapshot.isSecondOrder || !looksBackAt(snapshot.clock)) executor_->forgetHistory();
}

State Solver::state() {
  settle();
  convertVelocities();
  State state;
  executor_->download(state);
  if (!isSecondOrder()) forgetHistory(state);
  state.clock = inputs_.clock;
  state.integrator = inputs_.velocityMeaning;
  state.cuts = inputs_.cuts;
  state.offPath = inputs_.offPath;
  return state;
}

void Solver::setState(const State& state) {
  assert(state.positions.size() == inputs_.cloth->particleCount() &&
         "the state must be of the solver's cloth");
  stretch_.isSettled = true;
  setAllButParticles(state.clock, state.integrator, state.offPath, state.cuts);
  executor_->upload(state);
  if (state.clock.stepLength != inputs_.clock.stepLength) {
    inputs_.clock = state.clock;
    leaveHalfStep();
    inputs_.clock.setStepLength(stepLength(inputs_.scene->solver));
  }
  held_ = heldIn(state);
  if (!looksBackAt(state.clock)) executor_->forgetHistory();
}

bool Solver::isSecondOrder() const { return inputs_.scene->solver.integrator == Integrator::bdf2; }

// Whether the next step may look back at a step before that time.
bool Solver::looksBackAt(const StepClock& clock) const {
  return isSecondOrder() && clock.stepLength == stepLength(inputs_.scene->solver);
}

// What a state holds besides the particles.
void Solver::setAllButParticles(const StepClock& clock, Integrator integrator,
                                const std::vector<std::uint32_t>& offPath, const Cuts& cuts) {
  inputs_.clock = clock;
  inputs_.clock.setStepLength(stepLength(inputs_.scene->solver));
  inputs_.velocityMeaning = integrator;
  held_.clear();
  setOffPath(offPath);
  if (inputs_.cuts != cuts) setCuts(cuts);
  startIsChecked_ = false;
  divergence_.reset();
  executor_->forgetDivergence(inputs_.clock.step);
}

std::vector<Particle4> Solver::positions(std::uint32_t first, std::uint32_t count) {
  settle();
  return executor_->positions(first, count);
}

ContactCounts Solver::contactCounts() {
  settle();
  return executor_->contactCounts();
}

void Solver::forgetContactCounts() {
  settle();
  executor_->forgetContactCounts();
}

ConvergenceCounts Solver::convergenceCounts() {
  settle();
  return executor_->convergenceCounts();
}

void Solver::setInteraction(const Interaction& interaction) {
  settle();
  inputs_.interaction = interaction;
  prepare();
}

void Solver::setCuts(const Cuts& cuts) {
  settle();
  inputs_.cuts = cuts;
  levels_.reset();
  inputs_.cutMasks = makeCutMasks(*inputs_.cloth, cuts);
  makeLists();
  executor_->setCuts(inputs_);
  prepare();
}

void Solver::setPin(std::uint32_t particle, bool pinned) {
  settle();
  executor_->setInverseMass(particle, pinned ? 0 : 1 / inputs_.cloth->massOf(particle), true);
  std::vector<std::uint32_t> offPath = inputs_.offPath;
  leavePath(offPath, particle);
  setOffPath(std::move(offPath));
}

State initialState(const Cloth& cloth, const Scene& scene) {
  State state = stateAtRest(cloth);
  state.integrator = startingVelocityMeaning(scene);
  return state;
}

void jitter(State& state, double distance, std::uint32_t seed) {
  std::uint32_t drawn = 0;
  const auto moved = [&](float x) {
    return canonical(x + static_cast<float>(distance * uniform01(seed, drawn++)));
  };
  for (Particle4& x : state.positions)
    if (x.w > 0) x = {moved(x.x), moved(x.y), moved(x.z), x.w};
}

}  // namespace clothsim
