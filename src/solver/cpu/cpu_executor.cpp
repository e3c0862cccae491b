#include "solver/cpu/cpu_executor.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "core/exact_math.h"
#include "core/thread_team.h"
#include "core/vector_set.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/fixed_sum.h"
#include "solver/cpu/multilevel.h"

namespace clothsim {
namespace {

// Sums below this count as 0: their reciprocal would not be safe.
template <class Real>
constexpr Real leastSum = static_cast<Real>(0x1p-110f);

}  // namespace

template <class Real>
CpuExecutor<Real>::CpuExecutor(const Cloth& cloth, bool sweeps)
    : cloth_(&cloth),
      sweeps_(sweeps),
      restLengths_(measureRestLengths<Real>(cloth)),
      lists_(makeMeshLists<Real>(cloth)),
      stretches_(cpu::makeMeshStretches<Real>(cloth, lists_)),
      rowPasses_(cloth),
      selfCollision_(cloth) {
  (void)vectorSet();  // for its error, which may not come while threads compute
  const std::size_t count = cloth.particleCount();
  for (CpuState<Real>* state : {&particles_.state, &after_}) {
    state->positions.resize(count);
    state->velocities.resize(count);
  }
  forces_.resize(count);
  particles_.inverseMasses.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    cpu::put(particles_.state.positions, static_cast<std::ptrdiff_t>(i), startPosition<Real>(cloth, i));
    particles_.inverseMasses[i] = static_cast<Real>(cloth.inverseMasses()[i]);
  }
}

template <class Real>
void CpuExecutor<Real>::setScene(const StepInputs& inputs) {
  forgetHistory();
  distances_ = inputs.colliders.distances();
  selfCollision_.configure(*inputs.scene);
  setSurface(inputs);
}

template <class Real>
void CpuExecutor<Real>::setCuts(const StepInputs& inputs) {
  forgetHistory();
  selfCollision_.setCuts(inputs.cuts);
  if (cloth_->hasMesh()) {
    lists_ = makeMeshLists<Real>(*cloth_, inputs.cuts);
    stretches_ = cpu::makeMeshStretches<Real>(*cloth_, lists_);
  }
  setSurface(inputs);
  if (!implicit_.hierarchy.empty()) makeImplicitLists(inputs.cuts);
}

template <class Real>
void CpuExecutor<Real>::makeImplicitLists(const Cuts& cuts) {
  implicit_.resize(makeHierarchy<Real>(*cloth_, cuts), stretches_.membraneCount());
}

template <class Real>
void CpuExecutor<Real>::setSurface(const StepInputs& inputs) {
  implicit_.touching = {};
  implicit_.scalars.pairs = 0;
  hasSurface_ = hasSurface(*inputs.scene, *cloth_);
  if (hasSurface_)
    surfaceContact_.setSurface(makeSurface<Real>(*cloth_, *inputs.scene, inputs.cuts));
  else
    implicit_.pairSlips.clear();
}

template <class Real>
void CpuExecutor<Real>::prepare(const StepInputs& inputs, const PassList& list) {
  if (pinStarts_.x.size() != inputs.pinPaths.numbers.size()) {
    pinStarts_.resize(inputs.pinPaths.numbers.size());
    for (std::size_t i = 0; i < pinStarts_.x.size(); ++i)
      cpu::put(pinStarts_, static_cast<std::ptrdiff_t>(i), startPosition<Real>(*cloth_, i));
  }
  if (list.contains(Pass::begin) && implicit_.hierarchy.empty()) makeImplicitLists(inputs.cuts);
  if (list.contains(Pass::predictPlanes)) implicit_.planes.resize(cloth_->particleCount());
  if (list.contains(Pass::remember)) {
    implicit_.movedBefore.resize(cloth_->particleCount());
    implicit_.acceleratedBefore.resize(cloth_->particleCount());
  }
}

template <class Real>
cpu::PassArguments<Real> CpuExecutor<Real>::argumentsOf(const StepInputs& inputs, std::size_t piece) {
  const Interaction& interaction = inputs.interaction;
  const bool holds = interaction.grab && interaction.grab->piece == piece;
  return {parameters_.pieces[piece],
          parameters_.colliders.data(),
          distances_->data(),
          parameters_.pinMotions.data(),
          inputs.pinPaths.paths.empty() ? nullptr : inputs.pinPaths.numbers.data(),
          pinStarts_,
          particles_.inverseMasses.data(),
          restLengths_.data(),
          lists_,
          stretches_,
          parameters_.interaction,
          holds ? interaction.grab->points->data() : nullptr,
          interaction.jet.has_value(),
          inputs.cutMasks.empty() ? nullptr : inputs.cutMasks.data(),
          interaction.externalForces ? interaction.externalForces->data() : nullptr,
          particles_.state,
          after_,
          forces_,
          watch_};
}

template <class Real>
void CpuExecutor<Real>::run(const StepInputs& inputs, const PassList& list, int) {
  evaluate(inputs, 0, parameters_);
  pieces_.clear();
  for (std::size_t piece = 0; piece < cloth_->pieces().size(); ++piece)
    pieces_.push_back({argumentsOf(inputs, piece), implicit_});
  const std::span<const PassCall> passes = list.passes;
  for (std::size_t next = 0; next < passes.size();) {
    const std::span<const PassCall> rest = passes.subspan(next);
    if (isSkipped(rest.front().traits().gate)) {
      next = list.gateEnds[next];
      continue;
    }
    // Timed, so that each has its own time, passes do not go together further than a row of their own; nor
    // where seams join rows that are far apart.
    const bool byRows = isTimed_ || !lists_.seamStarts.empty();
    const std::size_t count = !sweeps_ ? 1 : byRows ? sweepLength(rest) : cpu::waveLength(rest);
    runSweep(rest.first(count));
    next += count;
    if (rest.front().pass == Pass::settle && isSkipped(Gate::step)) next = list.settledEnd;
  }
  adopt(list.outcome);
  if (list.contains(Pass::predictPlanes)) {
    std::swap(implicit_.planes.elasticSlips, implicit_.planes.newElasticSlips);
    std::swap(implicit_.planes.heldLimits, implicit_.planes.newHeldLimits);
  }
  if (list.contains(Pass::findTouching)) std::swap(implicit_.pairSlips, implicit_.newPairSlips);
}

template <class Real>
bool CpuExecutor<Real>::isSkipped(Gate gate) const {
  const ImplicitScalars<Real>& scalars = implicit_.scalars;
  return (gate != Gate::none && scalars.isStepSolved != 0) ||
         (gate == Gate::system && scalars.isSystemSolved != 0);
}

template <class Real>
void CpuExecutor<Real>::adopt(Outcome outcome) {
  if (outcome == Outcome::state) std::swap(particles_.state, after_);
  if (outcome == Outcome::velocities) std::swap(particles_.state.velocities, after_.velocities);
}

template <class Real>
void CpuExecutor<Real>::runSweep(std::span<const PassCall> passes) {
  const auto begin = std::chrono::steady_clock::now();
  const PassCall first = passes.front();
  switch (first.traits().domain) {
    case Domain::gridPoints:
    case Domain::particles:
    case Domain::springs:
      rowPasses_.run(passes, pieces_);
      break;
    case Domain::coarseVertices:
    case Domain::coarseBlocks:
    case Domain::fineVertices:
      cpu::runOnLevel<Real>(first, pieces_, implicit_, particles_.inverseMasses.data());
      break;
    case Domain::sums:
      sum(first.pass);
      break;
    case Domain::contacts:
    case Domain::surface:
      runContacts(first);
      break;
  }
  if (isTimed_)
    addTime(times_, nameOf(passes),
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

template <class Real>
void CpuExecutor<Real>::runContacts(PassCall call) {
  // Broken numbers may lie in one heap, and contacts in it take very long.
  if (firstDivergence(watch_, 0).has_value()) return;
  if (call.traits().domain == Domain::contacts)
    selfCollision_.run(call, particles_.state, after_, particles_.inverseMasses);
  else
    surfaceContact_.run(call, particles_.state, after_, implicit_, pieces_[0].step, particles_.inverseMasses);
}

// Where nothing is left, sums are 0 and nothing moves.
template <class Real>
void CpuExecutor<Real>::sum(Pass pass) {
  ImplicitScalars<Real>& scalars = implicit_.scalars;
  const auto product = [&](const Components<Real>& a, const Components<Real>& b) {
    return cpu::fixedSum(a, b, partialSums_);
  };
  const auto residual = [&] { return product(implicit_.residuals, implicit_.corrections); };
  switch (pass) {
    case Pass::sumFirstResidual: {
      const Real first = residual();
      scalars.residual = cpu::larger(first, Real(0));
      scalars.mostResidual = Real(LOST_RISE) * scalars.residual;
      scalars.isSystemSolved = first < Real(0) ? SYSTEM_LOST : 0;
      scalars.leastResidual = parameters_.pieces[0].systemTolerance * scalars.residual;
      if (scalars.newtonSteps > 0)
        scalars.leastResidual = cpu::larger(scalars.leastResidual, scalars.sufficientResidual);
      scalars.kept = 0;
      break;
    }
    case Pass::sumCurvature: {
      const Real curvature = product(implicit_.directions.positions, implicit_.products);
      scalars.stepSize = curvature > leastSum<Real> ? scalars.residual * reciprocal(curvature) : Real(0);
      if (curvature < Real(0)) refuseExactHessian();
      ++scalars.iterations;
      break;
    }
    case Pass::sumNextResidual: {
      const Real sum = residual(), next = cpu::larger(sum, Real(0));
      scalars.kept = scalars.residual > leastSum<Real> ? next * reciprocal(scalars.residual) : Real(0);
      scalars.residual = next;
      const bool isLost = sum < Real(0) || sum > scalars.mostResidual;
      scalars.isSystemSolved = isLost ? SYSTEM_LOST : next <= scalars.leastResidual ? 1 : 0;
      break;
    }
    case Pass::measureUpdate:
      measureUpdate();
      break;
    case Pass::countStep: {
      const bool isSolved = scalars.isStepSolved == 1, isUsual = scalars.hasNewContacts == 0;
      scalars.steps += 1;
      scalars.unconvergedSteps += isSolved ? 0 : 1;
      scalars.secondOrderSteps +=
          parameters_.pieces[0].secondRate > Real(0) && scalars.usualSteps >= USUAL_STEPS && isUsual ? 1 : 0;
      scalars.allIterations += scalars.iterations;
      scalars.allNewtonSteps += scalars.newtonSteps;
      const bool isSmall = scalars.isStepSolved != 0 && scalars.lastUpdate <= parameters_.pieces[0].tolerance;
      scalars.usualSteps = isSmall && isUsual && scalars.isDisturbed == 0 ? scalars.usualSteps + 1 : 0;
      scalars.hasNewContacts = scalars.isDisturbed = 0;
      scalars.hessian = HESSIAN_PROJECTED;
      scalars.isStepSolved = scalars.isSystemSolved = scalars.iterations = scalars.newtonSteps = 0;
      break;
    }
    default:
      chooseLength();
  }
}

namespace {

// The largest of |v|^2 over all particles; `most` for what is larger or no number.
template <class Real>
Real largestSquare(const Components<Real>& v, Real most) {
  const cpu::Arrays<const Real> values = cpu::arraysOf(v);
  Real largest = 0;
  for (std::size_t i = 0; i < v.x.size(); ++i) {
    const Vec3<Real> own = cpu::at(values, static_cast<std::ptrdiff_t>(i));
    const Real square = dot(own, own);
    largest = cpu::larger(largest, square < most ? square : most);
  }
  return largest;
}

}  // namespace

// The update over the motion of the step, or over the least motion that counts. An update is small, too,
// where the linear solver has hardly begun: r.z, the energy of what is missing as the preconditioner sees it,
// has to be small as well, against what such a motion would cost in inertia alone: linear systems of further
// Newton steps end where it is. And it has to be the update of an exact Newton step, or a tiny one. Where the
// exact Hessian was refused, and in contact, projected updates that fall will do: at the rate t of the last
// two, t/(1 - t) of the last one is still to come (Hairer and Wanner, "Solving ordinary differential
// equations II", IV.8), twice the tolerance at most; where nothing touches, at the rate of the two before,
// too: one Newton step stretches a stiff sheet that turns, and the small update of the next one undoes that.
// The first Newton step takes contacts as they were predicted: another one confirms it.
template <class Real>
void CpuExecutor<Real>::measureUpdate() {
  ImplicitScalars<Real>& scalars = implicit_.scalars;
  const StepParams<Real>& step = parameters_.pieces[0];
  const Real ownMotion = largestSquare(implicit_.displacements, Real(LARGE_SQUARE));
  const Real motion = cpu::larger(ownMotion, step.leastMotion * step.leastMotion);
  const bool touches = step.colliderCount != 0 || scalars.pairs != 0;
  const bool isNextThorough = scalars.newtonSteps + 1 < THOROUGH_NEWTON_STEPS;
  const Real later = touches ? Real(SUFFICIENT_RESIDUAL) : Real(SUFFICIENT_RESIDUAL_APART);
  const Real part = !isNextThorough ? later : touches ? Real(0) : Real(EARLY_RESIDUAL);
  // Not by the least motion: cloth at rest lies on planes less deep than that would leave undecided.
  scalars.sufficientResidual = part * (step.toleratedStiffness * ownMotion);
  const Real square = largestSquare(implicit_.increments, Real(LARGE_SQUARE)) * reciprocal(motion);
  const Real update = square * inverseSquareRoot(square);
  const bool isExact = scalars.hessian == HESSIAN_EXACT && scalars.isSystemSolved == 1;
  const bool isTiny = Real(touches ? TINY_UPDATE_IN_CONTACT : TINY_UPDATE) * update <= step.tolerance;
  const Real last = scalars.lastUpdate, most = Real(2) * step.tolerance;
  const bool isFalling =
      (touches || scalars.hessian == HESSIAN_REFUSED) && scalars.newtonSteps > 0 &&
      update * update <= most * (last - update) &&
      (touches || scalars.newtonSteps <= 2 || last * update <= most * (scalars.updateBefore - last));
  scalars.updateBefore = last;
  scalars.lastUpdate = update;
  const bool isFollowed =
      scalars.isSystemSolved != SYSTEM_LOST &&
      (scalars.isSystemSolved != 0 || scalars.residual <= step.toleratedStiffness * motion);
  const bool isConfirmed = !touches || scalars.newtonSteps > 0;
  scalars.isStepSolved =
      isConfirmed && update <= step.tolerance && isFollowed && (isExact || isTiny || isFalling) ? 1 : 0;
  scalars.isSystemSolved = 0;
  if (!touches && scalars.hessian != HESSIAN_REFUSED && update <= Real(EXACT_BELOW) * step.tolerance)
    scalars.hessian = HESSIAN_EXACT;
  else if (scalars.hessian == HESSIAN_EXACT)
    scalars.hessian = HESSIAN_REFUSED;
  ++scalars.newtonSteps;
}

// The search goes on from where it is, with a Hessian that is positive.
template <class Real>
void CpuExecutor<Real>::refuseExactHessian() {
  implicit_.scalars.isSystemSolved = SYSTEM_LOST;
  implicit_.scalars.hessian = HESSIAN_REFUSED;
}

// The longest of the lengths tried that does not raise the energy, else the shortest; with the exact Hessian,
// else none.
template <class Real>
void CpuExecutor<Real>::chooseLength() {
  const bool mayStay =
      implicit_.scalars.hessian == HESSIAN_EXACT || implicit_.scalars.isSystemSolved == SYSTEM_LOST;
  Real length = 1;
  for (int k = 0; k < LENGTHS_TRIED; ++k) {
    if (k == 1) tryShorterLengths();
    const std::vector<Real>& trial = implicit_.trials[static_cast<std::size_t>(k)];
    const Real change = cpu::fixedSum(trial, partialSums_);
    if (change <= Real(0)) break;
    if (k + 1 < LENGTHS_TRIED) {
      length = Real(0.5) * length;
    } else if (mayStay) {
      length = 0;
      refuseExactHessian();
    }
  }
  implicit_.scalars.newtonLength = length;
}

template <class Real>
void CpuExecutor<Real>::tryShorterLengths() {
  constexpr PassCall call{Pass::tryLengths};
  implicit_.triesShorter = true;
  rowPasses_.run({&call, 1}, pieces_);
  implicit_.triesShorter = false;
}

// What a step no longer needs holds the places that it did not leave its result in.
template <class Real>
void CpuExecutor<Real>::returnTo(const Real* positions, const Real* velocities) {
  const auto move = [](Components<Real>& from, const Real* place, Components<Real>& unused) {
    if (unused.x.data() != place) return;
    unused = from;
    std::swap(unused, from);
  };
  CpuState<Real>& state = particles_.state;
  move(state.positions, positions, after_.positions);
  move(state.positions, positions, selfCollision_.unusedPositions());
  move(state.velocities, velocities, after_.velocities);
  assert(state.positions.x.data() == positions && state.velocities.x.data() == velocities &&
         "returnTo() knows the places of this solver's particles");
}

template <class Real>
std::optional<Divergence> CpuExecutor<Real>::findDivergence(std::uint64_t step, bool) {
  return firstDivergence(watch_, step);
}

template <class Real>
void CpuExecutor<Real>::forgetDivergence(std::uint64_t) {
  watch_ = soundWatchRow();
}

template <class Real>
ConvergenceCounts CpuExecutor<Real>::convergenceCounts() {
  return convergenceOf(implicit_.scalars);
}

template <class Real>
void CpuExecutor<Real>::startTiming() {
  isTimed_ = true;
  times_.clear();
}

template <class Real>
std::vector<PassTime> CpuExecutor<Real>::stopTiming() {
  isTimed_ = false;
  return std::move(times_);
}

template <class Real>
std::string CpuExecutor<Real>::device() const {
  const int threads = ThreadTeam::shared().threads();
  return "CPU, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

template class CpuExecutor<float>;
template class CpuExecutor<double>;

}  // namespace clothsim
