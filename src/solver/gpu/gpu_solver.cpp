#include "solver/gpu/gpu_solver.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"

namespace clothsim {
namespace {

// How many steps' parameters are uploaded at once when they depend on time.
constexpr int BATCH_STEPS = 64;

void checkFits(std::size_t elements, std::size_t bytesEach, const char* what) {
  const std::size_t largest =
      std::min(static_cast<std::size_t>(gl::currentContextInfo().maxStorageBlockBytes) / bytesEach,
               gl::BufferTexture::largestSize());
  if (elements <= largest) return;
  throw OpenGlError("this cloth needs " + std::to_string(elements) + " " + what +
                    " in one buffer, and this driver allows " + std::to_string(largest) +
                    ". Use a smaller --resolution, or --backend cpu.");
}

}  // namespace

GpuSolver::GpuSolver(const Cloth& cloth, const Scene& scene, const GpuOptions& options)
    : cloth_(&cloth), scene_(scene), options_(options), velocityMeaning_(startingVelocityMeaning(scene)) {
  const std::size_t count = cloth.particleCount();
  checkFits(count, sizeof(Particle4), "particles");
  const std::vector<float> restLengths = measureRestLengths<float>(cloth);
  checkFits(restLengths.size(), sizeof(float), "rest lengths");
  restLengths_ = gl::Buffer<float>("rest lengths", std::span<const float>(restLengths));
  restLengthTexture_ = gl::BufferTexture("rest lengths", restLengths_.name(), GL_R32F);
  for (const auto& [arrays, name] :
       {std::pair{&positions_, "positions "}, std::pair{&velocities_, "velocities "}}) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string label = name + std::to_string(i);
      (*arrays)[i].buffer = gl::Buffer<Particle4>(label, count);
      (*arrays)[i].texture = gl::BufferTexture(label, (*arrays)[i].buffer.name(), GL_RGBA32F);
    }
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
  gl::checkErrors("the making of the GPU solver");  // above all: out of memory
}

void GpuSolver::configure(const Scene& scene) {
  assert(scene.cloths.size() == cloth_->grids().size() &&
         "configure() takes live edits of the solver's own scene");
  scene_ = scene;
  const std::size_t batch = dependsOnTime(scene) ? BATCH_STEPS : 1;
  if (stepSlots_.size() != batch * cloth_->grids().size()) {
    stagedSlots_.resize(batch * cloth_->grids().size());
    stepSlots_ = gl::Buffer<StepSlot>("step parameters", stagedSlots_.size());
  }
  if (colliders_.name() == 0 || colliders_.size() != batch * scene.colliders.size()) {
    stagedColliders_.resize(batch * scene.colliders.size());
    colliders_ = gl::Buffer<ColliderParams<float>>("colliders", stagedColliders_.size());
    colliderTexture_ = gl::BufferTexture("colliders", colliders_.name(), GL_RGBA32F);
  }
  paramsUploaded_ = false;
  choosePrograms();
}

void GpuSolver::choosePrograms() {
  gridPrograms_.clear();
  for (const Grid& grid : cloth_->grids()) {
    PassFeatures features = featuresOf(scene_, grid);
    features.groupColumns = options_.groupColumns;
    features.groupRows = options_.groupRows;
    features.fused = options_.fused;
    gridPrograms_.push_back(&programs_.try_emplace(features, features).first->second);
  }
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
      stagedColliders_[k * colliders + i] =
          makeColliderParams<float>(scene_, scene_.colliders[i], firstStep + k);
  }
  stepSlots_.upload({stagedSlots_.data(), static_cast<std::size_t>(count) * grids});
  colliders_.upload({stagedColliders_.data(), static_cast<std::size_t>(count) * colliders});
}

void GpuSolver::bindState() {
  const ParticleArray &x = positions_[now_], &v = velocities_[now_];
  const ParticleArray &newX = positions_[1 - now_], &newV = velocities_[1 - now_];
  x.texture.bind(POSITIONS_UNIT);
  v.texture.bind(VELOCITIES_UNIT);
  newX.texture.bind(NEW_POSITIONS_UNIT);
  newV.texture.bind(NEW_VELOCITIES_UNIT);
  newX.buffer.bindStorage(NEW_POSITIONS_BINDING);
  newV.buffer.bindStorage(NEW_VELOCITIES_BINDING);
}

void GpuSolver::runPass(const gl::Program& pass, const char* name, std::uint32_t columns,
                        std::uint32_t rows) {
  pass.bind();
  if (timer_ != nullptr) timer_->begin();
  gl::dispatch(columns, rows, options_.groupColumns, options_.groupRows);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  if (timer_ == nullptr) return;
  timer_->end();
  auto found = std::find_if(passTimes_.begin(), passTimes_.end(),
                            [&](const PassTime& time) { return time.name == name; });
  if (found == passTimes_.end()) found = passTimes_.insert(found, {name, 0});
  found->seconds += timer_->seconds();
}

void GpuSolver::limitStrain(std::size_t gridIndex) {
  const GridColors& grid = gridColors_[gridIndex];
  for (std::size_t i = 0; i < grid.colors.size(); ++i) {
    const LimitColor& color = grid.colors[i];
    limitColors_.bindUniformRange(LIMIT_COLOR_BINDING, grid.first + i, 1);
    runPass(gridPrograms_[gridIndex]->limit, "limit",
            ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn),
            ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow));
  }
}

void GpuSolver::stepGrid(std::size_t gridIndex, std::size_t slot) {
  const Grid& grid = cloth_->grids()[gridIndex];
  const auto columns = static_cast<std::uint32_t>(grid.columns), rows = static_cast<std::uint32_t>(grid.rows);
  const PassPrograms& programs = *gridPrograms_[gridIndex];
  stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, slot, 1);
  if (options_.fused) {
    runPass(programs.step, "step (forces, integrate, collide)", columns, rows);
  } else {
    runPass(programs.forces, "forces", columns, rows);
    runPass(programs.integrate, "integrate", columns, rows);
    runPass(programs.collide, "collide", columns, rows);
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
  restLengthTexture_.bind(REST_LENGTHS_UNIT);
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, grid, 1);
    runPass(gridPrograms_[grid]->kick, "kick", static_cast<std::uint32_t>(cloth_->grids()[grid].columns),
            static_cast<std::uint32_t>(cloth_->grids()[grid].rows));
  }
  std::swap(velocities_[0], velocities_[1]);
}

void GpuSolver::step(int count) {
  convertVelocities();
  forces_.bindStorage(FORCES_BINDING);
  restLengthTexture_.bind(REST_LENGTHS_UNIT);
  colliderTexture_.bind(COLLIDERS_UNIT);
  const std::size_t grids = cloth_->grids().size();
  const bool timed = dependsOnTime(scene_);
  for (int done = 0; done < count; ++done) {
    const int k = timed ? done % BATCH_STEPS : 0;
    if (timed ? k == 0 : !paramsUploaded_)
      uploadParams(stepIndex_, timed ? std::min(BATCH_STEPS, count - done) : 1);
    paramsUploaded_ = !timed;
    bindState();
    for (std::size_t grid = 0; grid < grids; ++grid)
      stepGrid(grid, static_cast<std::size_t>(k) * grids + grid);
    now_ = 1 - now_;
    ++stepIndex_;
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuSolver::finish() {
  glFinish();
  gl::checkErrors("the steps on the GPU");
}

State GpuSolver::state() {
  convertVelocities();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  State state;
  state.positions = positions_[now_].buffer.download();
  state.velocities = velocities_[now_].buffer.download();
  state.step = stepIndex_;
  state.integrator = velocityMeaning_;
  return state;
}

void GpuSolver::setState(const State& state) {
  assert(state.positions.size() == cloth_->particleCount() && "the state must be of the solver's cloth");
  positions_[now_].buffer.upload(state.positions);
  velocities_[now_].buffer.upload(state.velocities);
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
