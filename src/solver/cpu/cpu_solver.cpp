#include "solver/cpu/cpu_solver.h"

#include <omp.h>

#include <cassert>

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
    : cloth_(&cloth), fused_(fused), parallel_(cloth.particleCount() >= PARALLEL_PARTICLES) {
  const std::size_t count = cloth.particleCount();
  for (CpuState<Real>* state : {&before_, &after_}) {
    state->positions.resize(count);
    state->velocities.resize(count);
  }
  forces_.resize(count);
  inverseMasses_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    put(before_.positions, i, startPosition<Real>(cloth, i));
    inverseMasses_[i] = static_cast<Real>(cloth.inverseMasses()[i]);
  }
  restLengths_ = measureRestLengths<Real>(cloth);
  for (const Grid& grid : cloth.grids()) limitColors_.push_back(makeLimitColors(grid));
  velocityMeaning_ = startingVelocityMeaning(scene);
  configure(scene);
}

template <class Real>
void CpuSolver<Real>::configure(const Scene& scene) {
  assert(scene.cloths.size() == cloth_->grids().size() &&
         "configure() takes live edits of the solver's own scene");
  scene_ = scene;
  colliders_.resize(scene.colliders.size());
}

template <class Real>
cpu::PassArguments<Real> CpuSolver<Real>::arguments(const StepParams<Real>& params) {
  return {params, colliders_.data(), inverseMasses_.data(), restLengths_.data(), before_, after_, forces_};
}

template <class Real>
template <class Pass>
void CpuSolver<Real>::forEachRow(int rows, Pass pass) {
#pragma omp parallel for schedule(static) if (parallel_)
  for (int row = 0; row < rows; ++row) pass(row);
}

template <class Real>
void CpuSolver<Real>::prepareColliders() {
  for (std::size_t i = 0; i < colliders_.size(); ++i)
    colliders_[i] = makeColliderParams<Real>(scene_, scene_.colliders[i], stepIndex_);
}

// verlet carries v(n - 1/2), euler v(n): the difference is h a / 2.
template <class Real>
void CpuSolver<Real>::convertVelocities() {
  const Integrator wanted = scene_.solver.integrator;
  if (wanted == velocityMeaning_) return;
  velocityMeaning_ = wanted;
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    StepParams<Real> params = makeStepParams<Real>(scene_, *cloth_, grid, stepIndex_);
    params.kickTime = velocityConversionTime<Real>(scene_);
    const cpu::PassArguments<Real> pass = arguments(params);
    forEachRow(cloth_->grids()[grid].rows, [&](int row) { cpu::gatherForces(pass, row); });
    forEachRow(cloth_->grids()[grid].rows, [&](int row) { cpu::kick(pass, row); });
  }
  std::swap(before_.velocities, after_.velocities);
}

template <class Real>
void CpuSolver<Real>::stepGrid(std::size_t gridIndex) {
  const int rows = cloth_->grids()[gridIndex].rows;
  const StepParams<Real> params = makeStepParams<Real>(scene_, *cloth_, gridIndex, stepIndex_);
  const cpu::PassArguments<Real> pass = arguments(params);
  if (fused_) {
    forEachRow(rows, [&](int row) {
      cpu::gatherForces(pass, row);
      cpu::integrate(pass, row);
      cpu::collide(pass, row);
    });
  } else {
    forEachRow(rows, [&](int row) { cpu::gatherForces(pass, row); });
    forEachRow(rows, [&](int row) { cpu::integrate(pass, row); });
    forEachRow(rows, [&](int row) { cpu::collide(pass, row); });
  }
  if (!scene_.solver.strainLimit) return;
  for (const LimitColor& color : limitColors_[gridIndex]) {
    const std::uint32_t count = ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow);
    forEachRow(static_cast<int>(count),
               [&](int j) { cpu::limitStrain(pass, color, static_cast<std::uint32_t>(j)); });
  }
}

template <class Real>
void CpuSolver<Real>::step(int count) {
  convertVelocities();
  for (int i = 0; i < count; ++i) {
    prepareColliders();
    for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) stepGrid(grid);
    std::swap(before_, after_);
    ++stepIndex_;
  }
}

template <class Real>
State CpuSolver<Real>::state() {
  convertVelocities();
  State state;
  const std::size_t count = cloth_->particleCount();
  state.positions.resize(count);
  state.velocities.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f x = at(before_.positions, i).template cast<float>(),
                v = at(before_.velocities, i).template cast<float>();
    state.positions[i] = {x.x, x.y, x.z, static_cast<float>(inverseMasses_[i])};
    state.velocities[i] = {v.x, v.y, v.z, 0};
  }
  state.step = stepIndex_;
  state.integrator = velocityMeaning_;
  return state;
}

template <class Real>
void CpuSolver<Real>::setState(const State& state) {
  assert(state.positions.size() == cloth_->particleCount() && "the state must be of the solver's cloth");
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4 &x = state.positions[i], &v = state.velocities[i];
    put(before_.positions, i, Vec3f{x.x, x.y, x.z});
    put(before_.velocities, i, Vec3f{v.x, v.y, v.z});
    inverseMasses_[i] = static_cast<Real>(x.w);
  }
  stepIndex_ = state.step;
  velocityMeaning_ = state.integrator;
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
}
template <class Real>
void CpuSolver<Real>::setVelocity(std::uint32_t particle, Vec3<Real> velocity) {
  put(before_.velocities, particle, velocity);
}

template <class Real>
std::vector<Vec3<Real>> CpuSolver<Real>::forces() {
  std::vector<Vec3<Real>> result(cloth_->particleCount());
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    const StepParams<Real> params = makeStepParams<Real>(scene_, *cloth_, grid, stepIndex_);
    const cpu::PassArguments<Real> pass = arguments(params);
    forEachRow(cloth_->grids()[grid].rows, [&](int row) { cpu::gatherForces(pass, row); });
  }
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = at(forces_, i);
  return result;
}

template class CpuSolver<float>;
template class CpuSolver<double>;

}  // namespace clothsim
