#include "solver/cpu/cpu_solver.h"

#include <omp.h>

#include <cassert>

#include "core/interrupt.h"
#include "solver/cpu/collide.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/snapshot.h"

namespace clothsim {
namespace {

// Below this many particles a row-parallel pass costs more in waking threads than it saves.
constexpr std::uint32_t PARALLEL_PARTICLES = 8192;

template <class Real>
Vec3<Real> at(const Components<Real>& c, std::size_t i) {
  return {c.x[i], c.y[i], c.z[i]};
}
template <class Real, class Other>
void put(Components<Real>& c, std::size_t i, Vec3<Other> v) {
  c.x[i] = static_cast<Real>(v.x);
  c.y[i] = static_cast<Real>(v.y);
  c.z[i] = static_cast<Real>(v.z);
}

}  // namespace

template <class Real>
CpuSolver<Real>::CpuSolver(const Cloth& cloth, const Scene& scene, bool fused)
    : cloth_(&cloth),
      fused_(fused),
      parallel_(cloth.particleCount() >= PARALLEL_PARTICLES),
      selfCollision_(cloth, parallel_) {
  const std::size_t count = cloth.particleCount();
  for (CpuState<Real>* state : {&before_, &after_}) {
    state->positions.resize(count);
    state->velocities.resize(count);
  }
  forces_.resize(count);
  support_.resize(count);
  inverseMasses_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    put(before_.positions, i, startPosition<Real>(cloth, i));
    inverseMasses_[i] = static_cast<Real>(cloth.inverseMasses()[i]);
  }
  restLengths_ = measureRestLengths<Real>(cloth);
  lists_ = makeMeshLists<Real>(cloth);
  for (const Grid& grid : cloth.grids()) limitColors_.push_back(makeLimitColors(grid));
  velocityMeaning_ = startingVelocityMeaning(scene);
  configure(scene);
}

template <class Real>
void CpuSolver<Real>::configure(const Scene& scene) {
  assert(scene.cloths.size() == cloth_->grids().size() &&
         "configure() takes live edits of the solver's own scene");
  colliderSet_ = ColliderSet(scene);
  scene_ = scene;
  clock_.setStepLength(stepLength(scene.solver));
  colliders_.resize(scene.colliders.size());
  params_.resize(cloth_->grids().size());
  selfCollision_.configure(scene);
  if (scene.solver.integrator == Integrator::implicit && !implicitStep_)
    implicitStep_.emplace(*cloth_, parallel_).setCutMasks(cutMasks_);
  preparePins();
}

template <class Real>
void CpuSolver<Real>::preparePins() {
  pinPaths_ = makePinPaths(scene_, *cloth_, offPath_);
  pinMotions_.resize(pinPaths_.paths.size());
  if (pinPaths_.numbers.size() == pinStarts_.x.size()) return;
  pinStarts_.resize(pinPaths_.numbers.size());
  for (std::size_t i = 0; i < pinPaths_.numbers.size(); ++i)
    put(pinStarts_, i, startPosition<Real>(*cloth_, i));
}

template <class Real>
StepParams<Real> CpuSolver<Real>::paramsOf(std::size_t grid) const {
  StepParams<Real> params = makeStepParams<Real>(scene_, *cloth_, grid, clock_.time());
  addJet(hand_, params);
  return params;
}

template <class Real>
cpu::PassArguments<Real> CpuSolver<Real>::arguments(const StepParams<Real>& params) {
  const bool holds = hand_.hold && hand_.hold->grid == params.grid;
  return {params,
          colliders_.data(),
          colliderSet_.distances().data(),
          pinMotions_.data(),
          pinPaths_.paths.empty() ? nullptr : pinPaths_.numbers.data(),
          pinStarts_,
          inverseMasses_.data(),
          restLengths_.data(),
          lists_,
          handParams_,
          holds ? hand_.hold->points->data() : nullptr,
          hand_.jet.has_value(),
          cutMasks_.empty() ? nullptr : cutMasks_.data(),
          before_,
          after_,
          forces_,
          support_.data(),
          watch_};
}

template <class Real>
template <class Pass>
void CpuSolver<Real>::forEachRow(const Grid& grid, int rows, Pass pass) {
#pragma omp parallel for schedule(static) if (parallel_ && isWorthThreads(grid))
  for (int row = 0; row < rows; ++row) pass(row);
}

template <class Real>
void CpuSolver<Real>::prepareMotions() {
  handParams_ = makeHandParams<Real>(hand_, scene_, clock_.step);
  for (std::size_t i = 0; i < colliders_.size(); ++i)
    colliders_[i] = colliderSet_.params<Real>(i, clock_.time(), clock_.timeAfter(1));
  for (std::size_t i = 0; i < pinMotions_.size(); ++i)
    pinMotions_[i] = makePinMotionParams<Real>(pinPaths_.paths[i], clock_.timeAfter(1));
}

template <class Real>
void CpuSolver<Real>::forgetTrouble() {
  watch_ = soundWatchRow();
  trouble_.reset();
}

template <class Real>
void CpuSolver<Real>::checkStart() {
  if (startChecked_) return;
  startChecked_ = true;
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    const StepParams<Real> params = paramsOf(grid);
    const cpu::PassArguments<Real> pass = arguments(params);
    forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
               [&](int row) { cpu::checkStart(pass, row); });
  }
}

// verlet carries v(n - 1/2), euler v(n): the difference is h a / 2.
template <class Real>
void CpuSolver<Real>::convertVelocities() {
  const Integrator wanted = velocityMeaningOf(scene_.solver.integrator);
  if (wanted == velocityMeaning_) return;
  checkStart();
  velocityMeaning_ = wanted;
  handParams_ = makeHandParams<Real>(hand_, scene_, clock_.step);
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    StepParams<Real> params = paramsOf(grid);
    params.kickTime = velocityConversionTime<Real>(scene_);
    const cpu::PassArguments<Real> pass = arguments(params);
    forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
               [&](int row) { cpu::gatherForces(pass, row); });
    forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
               [&](int row) { cpu::kick(pass, row); });
  }
  std::swap(before_.velocities, after_.velocities);
  forgetSupport();
}

template <class Real>
void CpuSolver<Real>::forgetSupport() {
  if (std::exchange(hasSupport_, false)) std::fill(support_.begin(), support_.end(), Real(0));
}

// The passes of a step. Self-collision works on all grids at once, so each pass runs over all of them in
// turn.
template <class Real>
void CpuSolver<Real>::stepOnce() {
  const std::size_t grids = cloth_->grids().size();
  for (std::size_t grid = 0; grid < grids; ++grid) params_[grid] = paramsOf(grid);
  const auto forEachGridRow = [&](auto pass) {
    for (std::size_t grid = 0; grid < grids; ++grid) {
      const cpu::PassArguments<Real> ofGrid = arguments(params_[grid]);
      forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
                 [&](int row) { pass(ofGrid, row); });
    }
  };
  using Arguments = cpu::PassArguments<Real>;
  const auto gatherForces = [](const Arguments& pass, int row) { cpu::gatherForces(pass, row); };
  const auto integrate = [](const Arguments& pass, int row) { cpu::integrate(pass, row); };
  const auto collide = [](const Arguments& pass, int row) { cpu::collide(pass, row); };
  const auto collideAll = [&] {
    if (!scene_.colliders.empty()) forEachGridRow(collide);
  };
  const auto limitStrain = [&] {
    if (!limitsInPasses(scene_)) return;
    for (std::size_t grid = 0; grid < grids; ++grid) {
      const Arguments pass = arguments(params_[grid]);
      for (const LimitColor& color : limitColors_[grid]) {
        const std::uint32_t count = cpu::limitRows(cloth_->grids()[grid], color);
        forEachRow(cloth_->grids()[grid], static_cast<int>(count),
                   [&](int j) { cpu::limitStrain(pass, color, static_cast<std::uint32_t>(j)); });
      }
      forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
                 [&](int row) { cpu::watchLimit(pass, row); });
    }
  };

  // Broken numbers may lie in one heap, and contacts in it take very long.
  const auto isBroken = [&] { return firstTrouble(watch_, clock_.step + 1).has_value(); };

  const int rounds = contactRounds(scene_);
  const bool implicit = scene_.solver.integrator == Integrator::implicit;
  const bool fusesCollide = fused_ && !implicit && !selfCollision_.isOn();
  hasSupport_ = hasSupport_ || implicit;
  if (!implicit) forgetSupport();
  if (implicit) {
    implicitStep_->run(scene_.solver, [&](std::size_t grid) { return arguments(params_[grid]); });
  } else if (fused_) {
    forEachGridRow([&](const Arguments& pass, int row) {
      gatherForces(pass, row);
      integrate(pass, row);
      if (fusesCollide) collide(pass, row);
    });
  } else {
    forEachGridRow(gatherForces);
    forEachGridRow(integrate);
  }
  if (selfCollision_.isRobust()) {
    for (int round = 0; round < rounds; ++round) {
      limitStrain();
      collideAll();
    }
    if (!isBroken()) {
      selfCollision_.separate(before_, after_, inverseMasses_);
      selfCollision_.guard(before_, after_, inverseMasses_);
    }
    collideAll();
  } else {
    if (selfCollision_.isOn() && !isBroken()) selfCollision_.separate(before_, after_, inverseMasses_);
    if (!fusesCollide) collideAll();
    limitStrain();
    for (int round = 1; round < rounds; ++round) {
      collideAll();
      limitStrain();
    }
    if (rounds > 1) collideAll();
  }
}

template <class Real>
void CpuSolver<Real>::step(int count) {
  checkStart();
  convertVelocities();
  for (int i = 0; i < count && !trouble_ && !isInterrupted(); ++i) {
    prepareMotions();
    stepOnce();
    std::swap(before_, after_);
    ++clock_.step;
    trouble_ = firstTrouble(watch_, clock_.step);
  }
}

template <class Real>
std::optional<Trouble> CpuSolver<Real>::trouble() {
  if (!trouble_) trouble_ = firstTrouble(watch_, clock_.step + 1);  // of a kick
  return trouble_;
}

template <class Real>
std::unique_ptr<Snapshot> CpuSolver<Real>::snapshot(std::unique_ptr<Snapshot> reuse) {
  if (dynamic_cast<CpuSnapshot<Real>*>(reuse.get()) == nullptr) reuse = std::make_unique<CpuSnapshot<Real>>();
  auto& copy = static_cast<CpuSnapshot<Real>&>(*reuse);
  copy.particles = before_;
  copy.inverseMasses = inverseMasses_;
  copy.support = support_;
  copy.clock = clock_;
  copy.velocityMeaning = velocityMeaning_;
  copy.cuts = cuts_;
  copy.offPath = offPath_;
  return reuse;
}

template <class Real>
void CpuSolver<Real>::restore(const Snapshot& snapshot) {
  const auto* own = dynamic_cast<const CpuSnapshot<Real>*>(&snapshot);
  if (own == nullptr) return setState(snapshot.state());
  before_ = own->particles;
  inverseMasses_ = own->inverseMasses;
  support_ = own->support;
  hasSupport_ = true;
  clock_ = own->clock;
  clock_.setStepLength(stepLength(scene_.solver));
  velocityMeaning_ = own->velocityMeaning;
  offPath_ = own->offPath;
  preparePins();
  if (cuts_ != own->cuts) setCuts(own->cuts);
  startChecked_ = false;
  forgetTrouble();
}

template <class Real>
State CpuSolver<Real>::state() {
  convertVelocities();
  return snapshot(nullptr)->state();
}

template <class Real>
void CpuSolver<Real>::setState(const State& state) {
  assert(state.positions.size() == cloth_->particleCount() && "the state must be of the solver's cloth");
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4 &x = state.positions[i], &v = state.velocities[i];
    put(before_.positions, i, Vec3f{x.x, x.y, x.z});
    put(before_.velocities, i, Vec3f{v.x, v.y, v.z});
    inverseMasses_[i] = static_cast<Real>(x.w);
    support_[i] = static_cast<Real>(v.w);
  }
  hasSupport_ = true;
  clock_ = state.clock;
  clock_.setStepLength(stepLength(scene_.solver));
  velocityMeaning_ = state.integrator;
  offPath_ = state.offPath;
  preparePins();
  setCuts(state.cuts);
  selfCollision_.restart();
  startChecked_ = false;
  forgetTrouble();
}

template <class Real>
std::vector<Particle4> CpuSolver<Real>::positions(std::uint32_t first, std::uint32_t count) {
  std::vector<Particle4> result(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec3f x = at(before_.positions, first + k).template cast<float>();
    result[k] = {x.x, x.y, x.z, static_cast<float>(inverseMasses_[first + k])};
  }
  return result;
}

template <class Real>
void CpuSolver<Real>::setCuts(const Cuts& cuts) {
  cuts_ = cuts;
  cutMasks_ = makeCutMasks(*cloth_, cuts);
  selfCollision_.setCutMasks(cutMasks_);
  if (implicitStep_) implicitStep_->setCutMasks(cutMasks_);
}

template <class Real>
void CpuSolver<Real>::setPin(std::uint32_t particle, bool pinned) {
  inverseMasses_[particle] = pinned ? Real(0) : static_cast<Real>(1 / cloth_->massOf(particle));
  put(before_.velocities, particle, Vec3<Real>{});
  support_[particle] = 0;
  leavePath(offPath_, particle);
  preparePins();
}

template <class Real>
std::string CpuSolver<Real>::device() const {
  const int threads = omp_get_max_threads();
  return "CPU, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

template <class Real>
Vec3<Real> CpuSolver<Real>::position(std::uint32_t particle) const {
  return at(before_.positions, particle);
}
template <class Real>
Vec3<Real> CpuSolver<Real>::velocity(std::uint32_t particle) const {
  return at(before_.velocities, particle);
}
template <class Real>
void CpuSolver<Real>::setPosition(std::uint32_t particle, Vec3<Real> position) {
  put(before_.positions, particle, position);
  startChecked_ = false;
}
template <class Real>
void CpuSolver<Real>::setVelocity(std::uint32_t particle, Vec3<Real> velocity) {
  put(before_.velocities, particle, velocity);
  startChecked_ = false;
}

template <class Real>
std::vector<Vec3<Real>> CpuSolver<Real>::forces() {
  std::vector<Vec3<Real>> result(cloth_->particleCount());
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    const StepParams<Real> params = paramsOf(grid);
    handParams_ = makeHandParams<Real>(hand_, scene_, clock_.step);
    const cpu::PassArguments<Real> pass = arguments(params);
    forEachRow(cloth_->grids()[grid], cpu::rowsOf(cloth_->grids()[grid]),
               [&](int row) { cpu::gatherForces(pass, row); });
  }
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = at(forces_, i);
  return result;
}

template class CpuSolver<float>;
template class CpuSolver<double>;

}  // namespace clothsim
