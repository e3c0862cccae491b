#include "solver/gpu/gpu_solver.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "core/interrupt.h"
#include "solver/gpu/snapshot.h"

namespace clothsim {
namespace {

// How many steps' parameters are uploaded at once when they depend on time.
constexpr int BATCH_STEPS = GpuHand::MOST_STEPS;

// How many steps the watchdog remembers one by one. Who takes more without asking for trouble() has it looked
// for once in so many.
constexpr std::size_t WATCHED_STEPS = 1024;

}  // namespace

GpuSolver::GpuSolver(const Cloth& cloth, const Scene& scene, const GpuOptions& options)
    : cloth_(&cloth),
      scene_(scene),
      options_(options),
      velocityMeaning_(startingVelocityMeaning(scene)),
      selfCollision_(cloth, options.groupColumns, options.groupRows),
      runner_(options.groupColumns, options.groupRows) {
  const std::size_t count = cloth.particleCount();
  checkFits(count, sizeof(Particle4), "particles");
  const std::vector<float> restLengths = measureRestLengths<float>(cloth);
  checkFits(restLengths.size(), sizeof(float), "rest lengths");
  restLengths_ = gl::Buffer<float>("rest lengths", std::span<const float>(restLengths));
  restLengthTexture_ = gl::BufferTexture("rest lengths", restLengths_.name(), GL_R32F);
  lists_ = GpuMeshLists(cloth);
  for (std::size_t i = 0; i < 2; ++i) {
    positions_[i] = ParticleArray("positions " + std::to_string(i), count);
    velocities_[i] = ParticleArray("velocities " + std::to_string(i), count);
  }
  forces_ = gl::Buffer<Particle4>("forces", count);

  std::vector<ColorSlot> colorSlots;
  for (const Grid& grid : cloth.grids()) {
    gridColors_.push_back({colorSlots.size(), makeLimitColors(grid)});
    for (const LimitColor& color : gridColors_.back().colors) colorSlots.push_back({color});
  }
  limitColors_ = gl::Buffer<ColorSlot>("strain limit colours", std::span<const ColorSlot>(colorSlots));
  watch_ = gl::Buffer<WatchSlot>("watchdog", WATCHED_STEPS);
  setState(initialState(cloth, scene));
  startChecked_ = true;  // numbers of a scene are finite
  configure(scene);
  gl::checkErrors("the making of the GPU solver");  // above all: out of memory
}

void GpuSolver::configure(const Scene& scene) {
  assert(scene.cloths.size() == cloth_->grids().size() &&
         "configure() takes live edits of the solver's own scene");
  ColliderSet colliderSet(scene);
  if (distances_.name() == 0 || !colliderSet.hasSamplesOf(colliderSet_)) {
    const std::vector<float>& samples = colliderSet.distances();
    checkFits(samples.size(), sizeof(float), "samples of mesh colliders' distances");
    distances_ = gl::Buffer<float>("distances", std::span<const float>(samples));
    distanceTexture_ = gl::BufferTexture("distances", distances_.name(), GL_R32F);
  }
  colliderSet_ = std::move(colliderSet);
  scene_ = scene;
  clock_.setStepLength(stepLength(scene.solver));
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
  preparePins();
  paramsUploaded_ = false;
  selfCollision_.configure(scene);
  choosePrograms();
}

void GpuSolver::preparePins() {
  const std::size_t batch = dependsOnTime(scene_) ? BATCH_STEPS : 1;
  const std::vector<std::uint32_t> numbersBefore = std::move(pinPaths_.numbers);
  pinPaths_ = makePinPaths(scene_, *cloth_, offPath_);
  if (pinMotions_.name() == 0 || pinMotions_.size() != batch * pinPaths_.paths.size()) {
    stagedPinMotions_.resize(batch * pinPaths_.paths.size());
    pinMotions_ = gl::Buffer<PinMotionParams<float>>("pin motions", stagedPinMotions_.size());
    pinMotionTexture_ = gl::BufferTexture("pin motions", pinMotions_.name(), GL_RGBA32F);
  }
  if (pinStarts_.name() != 0 && pinPaths_.numbers == numbersBefore) return;
  std::vector<Particle4> starts(pinPaths_.numbers.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto x = startPosition<float>(*cloth_, i);
    starts[i] = {x.x, x.y, x.z, static_cast<float>(pinPaths_.numbers[i])};
  }
  pinStarts_ = gl::Buffer<Particle4>("start positions of pins", std::span<const Particle4>(starts));
  pinStartTexture_ = gl::BufferTexture("start positions of pins", pinStarts_.name(), GL_RGBA32F);
}

void GpuSolver::choosePrograms() {
  const bool implicit = scene_.solver.integrator == Integrator::implicit;
  std::vector<PassFeatures> ofGrids;
  gridPrograms_.clear();
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    PassFeatures features = featuresOf(scene_, *cloth_, grid, hand_.hand(), cuts_.cuts());
    features.groupColumns = options_.groupColumns;
    features.groupRows = options_.groupRows;
    features.fused = options_.fused;
    features.collidesInStep = !implicit && !selfCollision_.isOn();
    features.collidesAgain = contactRounds(scene_) > 1;
    gridPrograms_.push_back(library_.programsFor(features));
    ofGrids.push_back(features);
  }
  if (!implicit) return;
  const bool wind = ofGrids[0].wind, colliders = ofGrids[0].contactPlanes;
  if (!implicit_ || !implicit_->isFor(wind, colliders))
    implicit_.emplace(*cloth_, wind, colliders).setCutMasks(makeCutMasks(*cloth_, cuts_.cuts()));
  implicit_->choosePrograms(library_, ofGrids);
}

void GpuSolver::uploadParams(int count) {
  const std::size_t grids = cloth_->grids().size(), colliders = scene_.colliders.size(),
                    pinMotions = pinPaths_.paths.size();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    for (std::size_t grid = 0; grid < grids; ++grid) {
      StepParams<float>& params = stagedSlots_[k * grids + grid].params;
      params = makeStepParams<float>(scene_, *cloth_, grid, clock_.timeAfter(k));
      addJet(hand_.hand(), params);
      params.firstCollider = static_cast<std::uint32_t>(k * colliders);
      params.firstPinMotion = static_cast<std::uint32_t>(k * pinMotions);
      params.kickTime = velocityConversionTime<float>(scene_);
    }
    for (std::size_t i = 0; i < colliders; ++i)
      stagedColliders_[k * colliders + i] =
          colliderSet_.params<float>(i, clock_.timeAfter(k), clock_.timeAfter(k + 1));
    for (std::size_t i = 0; i < pinMotions; ++i)
      stagedPinMotions_[k * pinMotions + i] =
          makePinMotionParams<float>(pinPaths_.paths[i], clock_.timeAfter(k + 1));
  }
  stepSlots_.upload({stagedSlots_.data(), static_cast<std::size_t>(count) * grids});
  colliders_.upload({stagedColliders_.data(), static_cast<std::size_t>(count) * colliders});
  if (pinMotions > 0)
    pinMotions_.upload({stagedPinMotions_.data(), static_cast<std::size_t>(count) * pinMotions});
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
  bindWatch();
}

// The row of the next step. What comes after trouble is of no interest and shares the last row.
void GpuSolver::bindWatch() {
  if (clock_.step - watchBase_ >= WATCHED_STEPS) (void)trouble();
  watch_.bindStorageRange(WATCH_BINDING, std::min<std::size_t>(clock_.step - watchBase_, WATCHED_STEPS - 1),
                          1);
}

void GpuSolver::forgetTrouble() {
  static constexpr GLuint sound = NO_TROUBLE;
  glClearNamedBufferData(watch_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &sound);
  watchBase_ = clock_.step;
  trouble_.reset();
  selfCollision_.forgetTrouble();
}

std::optional<Trouble> GpuSolver::trouble() {
  if (trouble_) return trouble_;
  gl::checkContext();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  // The row of the next step counts: a kick may have come before it.
  const std::size_t rows = std::min<std::size_t>(clock_.step - watchBase_ + 1, WATCHED_STEPS);
  const std::vector<WatchSlot> slots = watch_.download(0, rows);
  for (std::size_t i = 0; i < rows && !trouble_; ++i)
    trouble_ = firstTrouble(slots[i].row, watchBase_ + i + 1);
  if (!trouble_) watchBase_ = clock_.step;  // nothing was written: the rows serve again
  return trouble_;
}

std::unique_ptr<Snapshot> GpuSolver::snapshot(std::unique_ptr<Snapshot> reuse) {
  const std::size_t count = cloth_->particleCount();
  const auto* old = dynamic_cast<const GpuSnapshot*>(reuse.get());
  if (old == nullptr || old->positions.size() != count) {
    auto fresh = std::make_unique<GpuSnapshot>();
    fresh->positions = gl::Buffer<Particle4>("kept positions", count);
    fresh->velocities = gl::Buffer<Particle4>("kept velocities", count);
    reuse = std::move(fresh);
  }
  auto& copy = static_cast<GpuSnapshot&>(*reuse);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy.positions.copyFrom(positions_[now_].buffer);
  copy.velocities.copyFrom(velocities_[now_].buffer);
  copy.clock = clock_;
  copy.velocityMeaning = velocityMeaning_;
  copy.cuts = cuts_.cuts();
  copy.offPath = offPath_;
  return reuse;
}

void GpuSolver::restore(const Snapshot& snapshot) {
  const auto* own = dynamic_cast<const GpuSnapshot*>(&snapshot);
  if (own == nullptr) return setState(snapshot.state());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  positions_[now_].buffer.copyFrom(own->positions);
  velocities_[now_].buffer.copyFrom(own->velocities);
  clock_ = own->clock;
  clock_.setStepLength(stepLength(scene_.solver));
  velocityMeaning_ = own->velocityMeaning;
  offPath_ = own->offPath;
  preparePins();
  if (cuts() != own->cuts) setCuts(own->cuts);
  startChecked_ = false;
  forgetTrouble();
}

void GpuSolver::run(const gl::Program& pass, const char* name, const Grid& grid) {
  runner_.run(pass, name, static_cast<std::uint32_t>(grid.columns), static_cast<std::uint32_t>(grid.rows));
}

void GpuSolver::limitStrain(std::size_t gridIndex) {
  const GridColors& grid = gridColors_[gridIndex];
  for (std::size_t i = 0; i < grid.colors.size(); ++i) {
    const LimitColor& color = grid.colors[i];
    limitColors_.bindUniformRange(LIMIT_COLOR_BINDING, grid.first + i, 1);
    runner_.run(*gridPrograms_[gridIndex].limit, "limit",
                ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn),
                ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow));
  }
  const Grid& points = cloth_->grids()[gridIndex];
  runner_.run(*gridPrograms_[gridIndex].watchLimit, "limit", static_cast<std::uint32_t>(points.columns),
              (static_cast<std::uint32_t>(points.rows) + WATCHED_ROWS - 1) / WATCHED_ROWS);
}

// The passes of a step. Self-collision works on all grids at once, so each pass runs over all of them in
// turn.
void GpuSolver::stepOnce(std::size_t batchStep) {
  const std::size_t grids = cloth_->grids().size();
  const auto bindGrid = [&](std::size_t grid) {
    stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, batchStep * grids + grid, 1);
  };
  const auto forEachGrid = [&](auto pass) {
    for (std::size_t grid = 0; grid < grids; ++grid) {
      bindGrid(grid);
      pass(cloth_->grids()[grid], gridPrograms_[grid], grid);
    }
  };
  const auto collide = [&](const Grid& grid, const PassPrograms& programs, std::size_t) {
    if (!scene_.colliders.empty()) run(*programs.collide, "collide", grid);
  };
  const auto limit = [&](const Grid&, const PassPrograms&, std::size_t grid) {
    if (limitsInPasses(scene_)) limitStrain(grid);
  };

  const int rounds = contactRounds(scene_);
  const bool implicit = scene_.solver.integrator == Integrator::implicit;
  const bool fusesCollide = options_.fused && !implicit && !selfCollision_.isOn();
  if (implicit) implicit_->run(runner_, scene_.solver, positions_[now_], bindGrid);
  forEachGrid([&](const Grid& grid, const PassPrograms& programs, std::size_t) {
    if (implicit) return;
    if (options_.fused) {
      run(*programs.step, fusesCollide ? "step (forces, integrate, collide)" : "step (forces, integrate)",
          grid);
    } else {
      run(*programs.forces, "forces", grid);
      run(*programs.integrate, "integrate", grid);
    }
  });
  if (selfCollision_.isRobust()) {
    for (int round = 0; round < rounds; ++round) {
      forEachGrid(limit);
      forEachGrid(collide);
    }
    selfCollision_.separate(runner_, positions_[1 - now_], bindGrid);
    selfCollision_.guard(runner_, positions_[now_], bindGrid);
    forEachGrid(collide);
  } else {
    if (selfCollision_.isOn()) selfCollision_.separate(runner_, positions_[1 - now_], bindGrid);
    if (!fusesCollide) forEachGrid(collide);
    forEachGrid(limit);
    for (int round = 1; round < rounds; ++round) {
      forEachGrid(collide);
      forEachGrid(limit);
    }
    if (rounds > 1) forEachGrid(collide);
  }
}

void GpuSolver::checkStart() {
  if (startChecked_) return;
  startChecked_ = true;
  uploadParams(1);
  paramsUploaded_ = !dependsOnTime(scene_);
  bindState();
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, grid, 1);
    run(*gridPrograms_[grid].start, "start", cloth_->grids()[grid]);
  }
}

// verlet carries v(n - 1/2), euler v(n): the difference is h a / 2.
void GpuSolver::convertVelocities() {
  const Integrator wanted = velocityMeaningOf(scene_.solver.integrator);
  if (wanted == velocityMeaning_) return;
  checkStart();
  velocityMeaning_ = wanted;
  uploadParams(1);
  paramsUploaded_ = !dependsOnTime(scene_);
  hand_.upload(scene_, clock_.step, 1);
  hand_.bind(0);
  cuts_.bind();
  bindState();
  restLengthTexture_.bind(REST_LENGTHS_UNIT);
  lists_.bind();
  for (std::size_t grid = 0; grid < cloth_->grids().size(); ++grid) {
    stepSlots_.bindUniformRange(STEP_PARAMS_BINDING, grid, 1);
    run(*gridPrograms_[grid].kick, "kick", cloth_->grids()[grid]);
  }
  std::swap(velocities_[0], velocities_[1]);
}

void GpuSolver::step(int count) {
  checkStart();
  convertVelocities();
  forces_.bindStorage(FORCES_BINDING);
  restLengthTexture_.bind(REST_LENGTHS_UNIT);
  lists_.bind();
  colliderTexture_.bind(COLLIDERS_UNIT);
  pinStartTexture_.bind(PIN_STARTS_UNIT);
  pinMotionTexture_.bind(PIN_MOTIONS_UNIT);
  distanceTexture_.bind(DISTANCES_UNIT);
  cuts_.bind();
  const bool timed = dependsOnTime(scene_);
  for (int done = 0; done < count && !isInterrupted(); ++done) {
    const int k = timed ? done % BATCH_STEPS : 0;
    if (timed ? k == 0 : !paramsUploaded_) uploadParams(timed ? std::min(BATCH_STEPS, count - done) : 1);
    paramsUploaded_ = !timed;
    if (done % BATCH_STEPS == 0) hand_.upload(scene_, clock_.step, std::min(BATCH_STEPS, count - done));
    hand_.bind(static_cast<std::size_t>(done % BATCH_STEPS));
    bindState();
    stepOnce(static_cast<std::size_t>(k));
    now_ = 1 - now_;
    ++clock_.step;
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuSolver::finish() {
  glFinish();
  gl::checkErrors("the steps on the GPU");
}

State GpuSolver::state() {
  gl::checkContext();
  convertVelocities();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  State state;
  state.positions = positions_[now_].buffer.download();
  state.velocities = velocities_[now_].buffer.download();
  state.clock = clock_;
  state.integrator = velocityMeaning_;
  state.cuts = cuts_.cuts();
  state.offPath = offPath_;
  return state;
}

void GpuSolver::setState(const State& state) {
  assert(state.positions.size() == cloth_->particleCount() && "the state must be of the solver's cloth");
  positions_[now_].buffer.upload(state.positions);
  velocities_[now_].buffer.upload(state.velocities);
  clock_ = state.clock;
  clock_.setStepLength(stepLength(scene_.solver));
  velocityMeaning_ = state.integrator;
  offPath_ = state.offPath;
  preparePins();
  if (cuts() != state.cuts) setCuts(state.cuts);
  selfCollision_.restart();
  startChecked_ = false;
  forgetTrouble();
}

std::vector<Particle4> GpuSolver::positions(std::uint32_t first, std::uint32_t count) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return positions_[now_].buffer.download(first, count);
}

void GpuSolver::setHand(const Hand& hand) {
  const bool jetBefore = hand_.hand().jet.has_value();
  hand_.set(hand);
  if (hand.jet.has_value() != jetBefore) paramsUploaded_ = false;  // the air may have come or gone
  choosePrograms();
}

void GpuSolver::setCuts(const Cuts& cuts) {
  const std::vector<std::uint32_t> masks = makeCutMasks(*cloth_, cuts);
  cuts_.set(cuts, masks);
  selfCollision_.setCut(!cuts.empty());
  if (implicit_) implicit_->setCutMasks(masks);
  choosePrograms();
}

// A few bytes are read back.
void GpuSolver::setPin(std::uint32_t particle, bool pinned) {
  Particle4 x = positions(particle, 1)[0];
  const Particle4 atRest;
  x.w = pinned ? 0.0f : static_cast<float>(1 / cloth_->massOf(particle));
  positions_[now_].buffer.upload({&x, 1}, particle);
  velocities_[now_].buffer.upload({&atRest, 1}, particle);
  leavePath(offPath_, particle);
  preparePins();
}

std::string GpuSolver::device() const {
  const gl::ContextInfo info = gl::currentContextInfo();
  return info.renderer + ", OpenGL " + std::to_string(info.major) + "." + std::to_string(info.minor);
}

std::vector<PassTime> GpuSolver::timePasses(int steps) {
  gl::Timer timer;
  runner_.startTiming(timer);
  step(steps);
  return runner_.stopTiming();
}

}  // namespace clothsim
