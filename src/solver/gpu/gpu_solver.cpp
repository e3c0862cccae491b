#include "solver/gpu/gpu_solver.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"

namespace clothsim {
namespace {

// How many steps' parameters are uploaded at once when they depend on time.
constexpr int BATCH_STEPS = 64;

void checkFits(std::size_t bytes, const char* what) {
  const auto largest = static_cast<std::size_t>(gl::currentContextInfo().maxStorageBlockBytes);
  if (bytes <= largest) return;
  throw OpenGlError("the " + std::string(what) + " need " + std::to_string(bytes >> 20) +
                    " MiB in one storage buffer, and this driver allows " + std::to_string(largest >> 20) +
                    " MiB. Use a smaller --resolution, or --backend cpu.");
}

}  // namespace

GpuSolver::GpuSolver(const Cloth& cloth, const Scene& scene, const GpuOptions& options)
    : cloth_(&cloth), scene_(scene), options_(options), velocityMeaning_(startingVelocityMeaning(scene)) {
  const gl::Defines defines{{"WORK_GROUP_COLUMNS", std::to_string(options.groupColumns)},
                            {"WORK_GROUP_ROWS", std::to_string(options.groupRows)}};
  stepPass_ = gl::Program::makeCompute("sim/step.comp", defines);
  forcesPass_ = gl::Program::makeCompute("sim/forces.comp", defines);
  integratePass_ = gl::Program::makeCompute("sim/integrate.comp", defines);
  collidePass_ = gl::Program::makeCompute("sim/collide.comp", defines);
  limitPass_ = gl::Program::makeCompute("sim/limit.comp", defines);
  kickPass_ = gl::Program::makeCompute("sim/kick.comp", defines);

  const std::size_t count = cloth.particleCount();
  checkFits(count * sizeof(Particle4), "particles");
  const std::vector<float> restLengths = measureRestLengths<float>(cloth);
  checkFits(restLengths.size() * sizeof(float), "rest lengths");
  restLengths_ = gl::Buffer<float>("rest lengths", std::span<const float>(restLengths));
  for (std::size_t i = 0; i < 2; ++i) {
    positions_[i] = gl::Buffer<Particle4>("positions " + std::to_string(i), count);
    velocities_[i] = gl::Buffer<Particle4>("velocities " + std::to_string(i), count);
  }
  forces_ = gl::Buffer<Particle4>("forces", count);

  std::vector<ColorSlot> colorSlots;
  for (const Grid& grid : cloth.grids()) {
    gridColors_.push_back({colorSlots.size(), makeLimitColors(grid)});
    for (const LimitColor& color : gridColors_.back().colors) colorSlots.push_back({color});
  }
  limitColors_ = gl::Buffer<ColorSlot>("strain limit colours", std::span<const ColorSlot>(colorSlots));
  setState(initialState(cloth, scene));
  configure(scene);
}

void GpuSolver::configure(const Scene& scene) {
  assert(scene.cloths.size() == cloth_->grids().size() && "configure() takes live edits of the solver's own scene");
  scene_ = scene;
  const std::size_t batch = dependsOnTime(scene) ? BATCH_STEPS : 1;
  if (stepSlots_.size() != batch * cloth_->grids().size()) {
    stagedSlots_.resize(batch * cloth_->grids().size());
    stepSlots_ = gl::Buffer<StepSlot>("step parameters", stagedSlots_.size());
  }
  if (colliders_.name() == 0 || colliders_.size() != batch * scene.colliders.size()) {
    stagedColliders_.resize(batch * scene.colliders.size());
    colliders_ = gl::Buffer<ColliderParams<float>>("colliders", stagedColliders_.size());
  }
  paramsUploaded_ = false;
}

void GpuSolver::uploadParams(std::uint64_t firstStep, int count) {
  const std::size_t grids = cloth_->grids().size(), colliders = scene_.colliders.size();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    for (std::size_t grid = 0; grid < grids; ++grid) {
      StepParams<float>& params = stagedSlots_[k * grids + grid].params;
      params = makeStepParams<float>(scene_, *cloth_, grid, firstStep + k);
      params.firstCollider = static_cast<std::uint32_t>(k * colliders);
      params.kickTime = velocityConversionTime<float>(scene_);
    }
    for (std::size_t i = 0; i < colliders; ++i)
      stagedColliders_[k * colliders + i] = makeColliderParams<float>(scene_, scene_.colliders[i], firstStep + k);
  }
  stepSlots_.upload({stagedSlots_.data(), static_cast<std::size_t>(count) * grids});
  colliders_.upload({stagedColliders_.data(), static_cast<std::size_t>(count) * colliders});
}

void GpuSolver::bindState() {
  positions_[now_].bindStorage(POSITIONS_BINDING);
  velocities_[now_].bindStorage(VELOCITIES_BINDING);
  positions_[1 - now_].bindStorage(NEW_POSITIONS_BINDING);
  velocities_[1 - now_].bindStorage(NEW_VELOCITIES_BINDING);
}

void GpuSolver::runPass(const gl::Program& pass, const char* name, std::uint32_t columns, std::uint32_t rows) {
  pass.bind();
  if (timer_ != nullptr) timer_->begin();
  gl::dispatch(columns, rows, options_.groupColumns, options_.groupRows);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (timer_ == nullptr) return;
  timer_->end();
  auto found = std::find_if(passTimes_.begin(), passTimes_.end(), [&](const PassTime& time) { return time.name == name; });
  if (found == passTimes_.end()) found = passTimes_.insert(found, {name, 0});
  found->seconds += timer_->seconds();
}

void GpuSolver::limitStrain(std::size_t gridIndex) {
  const GridColors& grid = gridColors_[gridIndex];
  for (std::size_t i = 0; i < grid.colors.size(); ++i) {
    const LimitColor& color = grid.colors[i];
    limitColors_.bindUniformRange(LIMIT_COLOR_BINDING, grid.first + i, 1);
    runPass(limitPass_, "limit", ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn),
            ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow));
  }
}

void GpuSolver::stepGrid(std::size_t gridIndex, std::size_t slot) {
  const Grid& grid = cloth_->grids()[gridIndex];
  const auto columns = static_cast<std::uint32_t>(grid.columns), rows = static_cast<std::uint32_t>(grid.rows);
  stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, slot, 1);
  if (options_.fused) {
    runPass(stepPass_, "step (forces, integrate, collide)", columns, rows);
  } else {
    runPass(forcesPass_, "forces", columns, rows);
    runPass(integratePass_, "integrate", columns, rows);
    runPass(collidePass_, "collide", columns, rows);
  }
  if (scene_.solver.strainLimit) limitStrain(gridIndex);
}

// verlet carries v(n - 1/2), euler v(n): the difference is h a / 2.
void GpuSolver::convertVelocities() {
  if (scene_.solver.integrator == velocityMeaning_) return;
  velocityMeaning_ = scene_.solver.integrator;
  uploadParams(stepIndex_, 1);
  paramsUploaded_ = !dependsOnTime(scene_);
  bindState();
  restLengths_.bindStorage(REST_LENGTHS_BINDING);
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, grid, 1);
    runPass(kickPass_, "kick", static_cast<std::uint32_t>(cloth_->grids()[grid].columns),
            static_cast<std::uint32_t>(cloth_->grids()[grid].rows));
  }
  std::swap(velocities_[0], velocities_[1]);
}

void GpuSolver::step(int count) {
  convertVelocities();
  forces_.bindStorage(FORCES_BINDING);
  restLengths_.bindStorage(REST_LENGTHS_BINDING);
  colliders_.bindStorage(COLLIDERS_BINDING);
  const std::size_t grids = cloth_->grids().size();
  const bool timed = dependsOnTime(scene_);
  for (int done = 0; done < count; ++done) {
    const int k = timed ? done % BATCH_STEPS : 0;
    if (timed ? k == 0 : !paramsUploaded_) uploadParams(stepIndex_, timed ? std::min(BATCH_STEPS, count - done) : 1);
    paramsUploaded_ = !timed;
    bindState();
    for (std::size_t grid = 0; grid < grids; ++grid) stepGrid(grid, static_cast<std::size_t>(k) * grids + grid);
    now_ = 1 - now_;
    ++stepIndex_;
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuSolver::finish() { glFinish(); }

State GpuSolver::state() {
  convertVelocities();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  State state;
  state.positions = positions_[now_].download();
  state.velocities = velocities_[now_].download();
  state.step = stepIndex_;
  state.integrator = velocityMeaning_;
  return state;
}

void GpuSolver::setState(const State& state) {
  assert(state.positions.size() == cloth_->particleCount() && "the state must be of the solver's cloth");
  positions_[now_].upload(state.positions);
  velocities_[now_].upload(state.velocities);
  stepIndex_ = state.step;
  velocityMeaning_ = state.integrator;
}

std::string GpuSolver::device() const {
  const gl::ContextInfo info = gl::currentContextInfo();
  return info.renderer + ", OpenGL " + std::to_string(info.major) + "." + std::to_string(info.minor);
}

std::vector<PassTime> GpuSolver::timePasses(int steps) {
  gl::Timer timer;
  passTimes_.clear();
  timer_ = &timer;
  step(steps);
  timer_ = nullptr;
  return std::move(passTimes_);
}

}  // namespace clothsim
