#include "solver/gpu/gpu_executor.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/error.h"
#include "gl/bindings.h"
#include "solver/tearing.h"

namespace clothsim {
namespace {

// As many as every driver takes in a work group.
constexpr int MOST_LANES = 1024;
// And in a dispatch.
constexpr std::size_t MOST_GROUPS = 65535;
// Of conjugate gradients, between two looks at the flags.
constexpr int ITERATIONS_UNSEEN = 4;

std::uint32_t ownersAcross(const LimitColor& color) {
  return ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn);
}
std::uint32_t ownersAlong(const LimitColor& color) {
  return ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow);
}

constexpr std::size_t OF_CONTACT = std::numeric_limits<std::size_t>::max();  // instead of a kernel's number

// How many pairs of the second colour a line of `points` has, those with one end beyond the line's ends too.
std::uint32_t middlePairs(std::uint32_t points, int offset) {
  const auto reach = static_cast<std::uint32_t>(std::abs(offset));
  return ownerCount(0, 2 * reach, reach, points + reach);
}

bool haveSameSlots(const Cloth& cloth) {
  const Piece& first = cloth.pieces().front();
  return std::all_of(cloth.pieces().begin(), cloth.pieces().end(), [&](const Piece& piece) {
    return !piece.isMesh && piece.slotEnabled == first.slotEnabled;
  });
}

// Two storage blocks more than what every device must have for the passes (gl/requirements.h).
bool hasPlacesForStorageLoads() {
  GLint blocks = 0, places = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &blocks);
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &places);
  return blocks >= 11 && places > VELOCITIES_BINDING;
}

// A software renderer steps through every lane of a group at each barrier, needed or not. On hardware, groups
// of several rows read their neighbours' points less often.
GpuOptions forThisDevice(GpuOptions options) {
  const bool software = gl::currentContextInfo().software;
  if (options.coarseLanes == 0) options.coarseLanes = software ? SUM_LANES : MOST_LANES;
  if (options.groupColumns == 0) {
    options.groupColumns = software ? 64 : 32;
    options.groupRows = software ? 1 : 8;
  }
  if (!options.limitsInTiles) options.limitsInTiles = !software;
  if (!options.coarsensInGroups) options.coarsensInGroups = !software;
  if (!options.looksAtFlags) options.looksAtFlags = software ? FlagLooks::always : FlagLooks::whenReady;
  if (!options.storageLoads) options.storageLoads = !software && hasPlacesForStorageLoads();
  return options;
}

}  // namespace

GpuExecutor::GpuExecutor(const Cloth& cloth, const GpuOptions& options)
    : cloth_(&cloth),
      options_(forThisDevice(options)),
      arrays_(cloth.particleCount()),
      lists_(cloth),
      kernels_(kernels().size()),
      selfCollision_(cloth, options_.groupColumns, options_.groupRows) {
  const std::vector<float> restLengths = measureRestLengths<float>(cloth);
  checkTexelsFit(restLengths.size(), "rest lengths");
  restLengths_ = gl::Buffer<float>("rest lengths", std::span<const float>(restLengths));
  restLengthTexture_ = gl::BufferTexture("rest lengths", restLengths_.name(), GL_R32F);
  std::vector<ColorSlot> slots;
  for (const Piece& piece : cloth.pieces()) {
    firstColors_.push_back(slots.size());
    colors_.push_back(makeLimitColors(piece));
    for (const LimitColor& color : colors_.back()) slots.push_back({color});
  }
  kernelOptions_ = {options_.fused, cloth.pieces().size() == 1, haveSameSlots(cloth),
                    *options_.limitsInTiles && !cloth.hasMesh(), *options_.coarsensInGroups};
  colorSlots_ = gl::Buffer<ColorSlot>("strain limit colours", std::span<const ColorSlot>(slots));
  upload(stateAtRest(cloth));
  gl::checkErrors("the making of the GPU solver");  // above all: out of memory
}

void GpuExecutor::setScene(const StepInputs& inputs) {
  arrays_.forgetHistory();
  if (distances_.name() == 0 || *inputs.colliders.distances() != *stagedDistances_) {
    stagedDistances_ = inputs.colliders.distances();
    checkTexelsFit(stagedDistances_->size(), "samples of mesh colliders' distances");
    distances_ = gl::Buffer<float>("distances", std::span<const float>(*stagedDistances_));
    distanceTexture_ = gl::BufferTexture("distances", distances_.name(), GL_R32F);
  }
  selfCollision_.configure(*inputs.scene);
  setSurface(inputs);
}

void GpuExecutor::setSurface(const StepInputs& inputs) {
  arrays_.forgetPairs();
  if (hasSurface(*inputs.scene, *cloth_))
    surfaceContact_.setSurface(makeSurface<float>(*cloth_, *inputs.scene, inputs.cuts),
                               cloth_->particleCount(), featuresOf(*inputs.scene, *cloth_, 0));
  else
    surfaceContact_.switchOff();
}

void GpuExecutor::setCuts(const StepInputs& inputs) {
  cutMasks_ = {};  // made by prepare()
  if (cloth_->hasMesh()) lists_ = GpuMeshLists(*cloth_, inputs.cuts);
  arrays_.forgetHistory();
  levels_ = {};  // made anew when an implicit step needs them: no weight crosses a cut
  selfCollision_.setCut(!inputs.cuts.empty());
  setSurface(inputs);
}

void GpuExecutor::prepare(const StepInputs& inputs, const PassList& list) {
  parameters_.prepare(inputs);
  if (list.contains(Pass::begin)) {
    if (levels_.empty())
      levels_ = GpuLevels(makeHierarchy<float>(*cloth_, inputs.cuts), options_.verticesAlone);
    arrays_.addImplicit(cloth_->particleCount(), levels_,
                        hasAir(*inputs.scene) || inputs.interaction.jet.has_value(),
                        !inputs.scene->colliders.empty(), list.contains(Pass::remember));
    if (flags_.elements().empty())
      flags_ = gl::MappedBuffer<ImplicitScalars<float>>("flags of implicit steps", 1);
  }
  if (mayBeCut(*inputs.scene, inputs.cuts) && cutMasks_.size() == 0) {
    const std::vector<std::uint32_t> none(inputs.cuts.empty() ? cloth_->particleCount() : 0);
    cutMasks_ =
        gl::Buffer<std::uint32_t>("cut masks", std::span(inputs.cuts.empty() ? none : inputs.cutMasks));
    cutMaskTexture_ = gl::BufferTexture("cut masks", cutMasks_.name(), GL_R32UI);
  }
  if (list.contains(Pass::limit) || list.contains(Pass::resolveContacts))
    arrays_.addSpare(Array::newPositions);
  for (std::vector<StagePrograms>& programs : kernels_) programs.clear();
  compile(inputs, list);
  compile(inputs, makeConversion());
  compile(inputs, makeStartCheck());
}

void GpuExecutor::compile(const StepInputs& inputs, const PassList& list) {
  for (std::span<const PassCall> rest = list.passes; !rest.empty();) {
    const KernelChoice choice = choose(rest);
    rest = rest.subspan(choice.passes);
    if (choice.kernel == OF_CONTACT || !kernels_[choice.kernel].empty()) continue;
    const Kernel& kernel = kernels()[choice.kernel];
    std::vector<StagePrograms>& programs = kernels_[choice.kernel];
    programs.resize(kernel.stages.size());
    for (std::size_t piece = 0; piece < cloth_->pieces().size(); ++piece) {
      PassFeatures features = featuresOf(*inputs.scene, *cloth_, piece, inputs.interaction, inputs.cuts);
      features.groupColumns = options_.groupColumns;
      features.groupRows = options_.groupRows;
      features.storageLoads = *options_.storageLoads;
      features.coarseLanes = options_.coarseLanes;
      const std::vector<const gl::Program*> found = library_.find(kernel, features);
      for (std::size_t stage = 0; stage < programs.size(); ++stage) programs[stage].push_back(found[stage]);
    }
  }
}

void GpuExecutor::run(const StepInputs& inputs, const PassList& list, int steps) {
  const gl::KeptBindings bindings;
  parameters_.bind(inputs, steps);
  arrays_.bindTextures(*options_.storageLoads);
  arrays_[Array::forces].buffer.bindStorage(FORCES_BINDING);
  restLengthTexture_.bind(REST_LENGTHS_UNIT);
  distanceTexture_.bind(DISTANCES_UNIT);
  lists_.bind();
  if (cutMasks_.size() > 0) cutMaskTexture_.bind(CUT_MASKS_UNIT);
  levels_.bind();
  surfaceContact_.bindTextures();
  watch_.bind(inputs.clock.step);

  seen_.reset();
  flagsAreThere_.reset();
  areOfThisSystem_ = isStepKnownSolved_ = isSystemKnownSolved_ = false;
  const std::span<const PassCall> passes = list.passes;
  for (std::size_t next = 0; next < passes.size();) {
    const std::span<const PassCall> rest = passes.subspan(next);
    if (isClosed(rest.front().traits().gate)) {
      next = list.gateEnds[next];
      continue;
    }
    const KernelChoice choice = choose(rest);
    const std::span<const PassCall> taken = rest.first(choice.passes);
    runKernel(choice.kernel, taken);
    askForFlags(taken);
    next += taken.size();
    if (rest.front().pass == Pass::settle && isClosed(Gate::step)) next = list.settledEnd;
  }

  if (list.outcome == Outcome::state) std::swap(arrays_[Array::positions], arrays_[Array::newPositions]);
  if (list.contains(Pass::predictPlanes))
    std::swap(arrays_[Array::elasticSlips], arrays_[Array::newElasticSlips]);
  if (list.outcome != Outcome::nothing) std::swap(arrays_[Array::velocities], arrays_[Array::newVelocities]);
}

// Whether the passes behind the gate would do nothing (sim/implicit/gate.glsl), as far as that is known here.
bool GpuExecutor::isClosed(Gate gate) {
  if (gate == Gate::none || *options_.looksAtFlags == FlagLooks::never) return false;
  if (*options_.looksAtFlags == FlagLooks::whenReady) {
    lookAtFlags();
    return isStepKnownSolved_ || (gate == Gate::system && isSystemKnownSolved_);
  }
  if (!seen_) seen_ = arrays_.scalars();
  return seen_->isStepSolved != 0 || (gate == Gate::system && seen_->isSystemSolved != 0);
}

// What has been dispatched since the copy was asked for did nothing, if it says so.
void GpuExecutor::lookAtFlags() {
  if (!flagsAreThere_.isReached()) return;
  flagsAreThere_.reset();
  const ImplicitScalars<float>& flags = flags_.elements()[0];
  isStepKnownSolved_ = flags.isStepSolved != 0;
  isSystemKnownSolved_ = areOfThisSystem_ && flags.isSystemSolved != 0;
}

// Passes of contact have kernels of their own, one each.
KernelChoice GpuExecutor::choose(std::span<const PassCall> passes) const {
  const Domain domain = passes.front().traits().domain;
  if (domain == Domain::contacts || domain == Domain::surface) return {OF_CONTACT, 1};
  const KernelChoice choice = kernelFor(passes, kernelOptions_);
  assert(
      (kernels()[choice.kernel].stages.front().over != Over::grids || choice.passes <= sweepLength(passes)) &&
      "passes over grid points that have one shader must be able to share a sweep");
  return choice;
}

// Behind a Newton step, where the step goes on or does not (Pass::settle), and behind some iterations of
// conjugate gradients unless an answer is still to come: devices that lag behind would never give one.
void GpuExecutor::askForFlags(std::span<const PassCall> passes) {
  if (*options_.looksAtFlags != FlagLooks::whenReady) return;
  const auto hasAny = [&](auto... wanted) {
    return std::ranges::any_of(passes, [&](const PassCall& c) { return ((c.pass == wanted) || ...); });
  };
  if (hasAny(Pass::linearize)) areOfThisSystem_ = isSystemKnownSolved_ = false;
  const bool endsNewtonStep = hasAny(Pass::measureUpdate, Pass::settle),
             endsIteration = hasAny(Pass::sumFirstResidual, Pass::sumNextResidual);
  if (!endsNewtonStep && !endsIteration) return;
  if (endsIteration && (flagsAreThere_.isSet() || ++iterationsUnseen_ < ITERATIONS_UNSEEN)) return;
  if (endsNewtonStep) isStepKnownSolved_ = false;
  areOfThisSystem_ = endsIteration;
  iterationsUnseen_ = 0;
  arrays_.copyScalars(flags_);
  flagsAreThere_.set();
  glFlush();  // or the copy may wait for further commands
}

void GpuExecutor::runKernel(std::size_t number, std::span<const PassCall> passes) {
  const PassCall& call = passes.front();
  if (std::ranges::any_of(passes,
                          [](const PassCall& c) { return c.traits().writes.contains(Array::scalars); }))
    seen_.reset();
  if (call.traits().domain == Domain::contacts)
    return selfCollision_.run(runner_, call, arrays_,
                              [&](std::size_t piece) { parameters_.bindPiece(piece); });
  if (call.traits().domain == Domain::surface) {
    seen_.reset();
    return surfaceContact_.run(runner_, call, arrays_);
  }
  const Kernel& kernel = kernels()[number];
  const std::string name = runner_.isTiming() ? nameOf(passes) : "";
  for (const Pass own : kernel.passes) arrays_.bindFor(own);
  if (kernel.rewritten) arrays_.bindSpare(*kernel.rewritten);
  for (std::size_t stage = 0; stage < kernel.stages.size(); ++stage)
    runStage(kernel.stages[stage].over, kernels_[number][stage], call, name);
  if (kernel.rewritten) arrays_.takeSpare(*kernel.rewritten);
}

void GpuExecutor::runStage(Over over, const StagePrograms& programs, const PassCall& call,
                           const std::string& name) {
  switch (over) {
    case Over::grids:
      return runOnGrids(programs, call, name);
    case Over::particles:
      return runOnEntries(*programs[0], name, cloth_->particleCount());
    case Over::colors:
      return runOnColor(programs, call.index, name);
    case Over::tiles:
      return runOnTiles(programs, name);
    case Over::slots:
      return runOnSlot(programs, call.index, name);
    case Over::levels:
      return runOnLevel(programs, call, name);
    case Over::firstLevels:
      return call.index == 0 ? runOnLevel(programs, call, name) : void();
    case Over::furtherLevels:
      return call.index > 0 ? runOnLevel(programs, call, name) : void();
    case Over::furtherBlocks:
      return call.index > 0 ? runOnBlocks(programs, call.index, name) : void();
    case Over::restrictions:
      return runRestrictions(programs, name);
    case Over::prolongations:
      return runProlongations(programs, name);
    case Over::parts:
      return runner_.runGroups(*programs[0], name,
                               static_cast<std::uint32_t>(std::min(levels_.parts(), MOST_GROUPS)));
    case Over::sumBlocks:
      return runner_.runGroups(*programs[0], name,
                               static_cast<std::uint32_t>(arrays_[Array::partialSums].buffer.size()));
    case Over::once:
      return runner_.runGroups(*programs[0], name, 1);
  }
}

void GpuExecutor::runOnGrids(const StagePrograms& programs, const PassCall& call, const std::string& name) {
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Piece& piece = cloth_->pieces()[i];
    const auto columns = static_cast<std::uint32_t>(piece.columns);
    auto rows = static_cast<std::uint32_t>(piece.rows);
    if (call.pass == Pass::watchLimit) rows = (rows + WATCHED_ROWS - 1) / WATCHED_ROWS;
    parameters_.bindPiece(i);
    runner_.run(*programs[i], name, columns, rows);
  }
}

void GpuExecutor::runOnColor(const StagePrograms& programs, std::size_t number, const std::string& name) {
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (number >= colors_[i].size()) continue;
    const LimitColor& color = colors_[i][number];
    parameters_.bindPiece(i);
    colorSlots_.bindUniformRange(LIMIT_COLOR_BINDING, firstColors_[i] + number, 1);
    runner_.run(*programs[i], name, ownersAcross(color), ownersAlong(color));
  }
}

void GpuExecutor::runOnTiles(const StagePrograms& programs, const std::string& name) {
  const auto tiles = [](int points) {
    return static_cast<std::uint32_t>((points + LIMIT_TILE - 1) / LIMIT_TILE);
  };
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Piece& piece = cloth_->pieces()[i];
    parameters_.bindPiece(i);
    runner_.runGroups(*programs[i], name, tiles(piece.columns), tiles(piece.rows));
  }
}

void GpuExecutor::runOnSlot(const StagePrograms& programs, std::size_t firstColor, const std::string& name) {
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Piece& piece = cloth_->pieces()[i];
    const SpringOffset& offset = springOffsets[colors_[i][firstColor].slot];
    auto columns = static_cast<std::uint32_t>(piece.columns), rows = static_cast<std::uint32_t>(piece.rows);
    if (offset.rows == 0)
      columns = middlePairs(columns, offset.columns);
    else
      rows = middlePairs(rows, offset.rows);
    parameters_.bindPiece(i);
    colorSlots_.bindUniformRange(LIMIT_COLOR_BINDING, firstColors_[i] + firstColor, 1);
    runner_.run(*programs[i], name, columns, (rows + LINES_AT_ONCE - 1) / LINES_AT_ONCE);
  }
}

void GpuExecutor::runOnEntries(const gl::Program& program, const std::string& name, std::uint32_t count) {
  runner_.run(program, name, std::min(count, PARTICLES_A_ROW),
              (count + PARTICLES_A_ROW - 1) / PARTICLES_A_ROW);
}

void GpuExecutor::runOnLevel(const StagePrograms& programs, const PassCall& call, const std::string& name) {
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (call.index >= levels_.ofPiece(i).size()) continue;
    const LevelParams& level = levels_.ofPiece(i)[call.index];
    const std::uint32_t count = call.traits().domain == Domain::coarseBlocks
                                    ? level.endBlock - level.firstBlock
                                : call.traits().domain == Domain::fineVertices ? level.fineCount
                                                                               : level.coarseCount;
    parameters_.bindPiece(i);
    levels_.bindLevel(i, call.index);
    runOnEntries(*programs[i], name, count);
  }
}

// A work group for each block of the level's matrix.
void GpuExecutor::runOnBlocks(const StagePrograms& programs, std::size_t index, const std::string& name) {
  const PassRunner::SideBySide cloths(runner_);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (index >= levels_.ofPiece(i).size()) continue;
    const LevelParams& level = levels_.ofPiece(i)[index];
    const std::uint32_t blocks = level.endBlock - level.firstBlock,
                        across = std::min(blocks, PARTICLES_A_ROW);
    parameters_.bindPiece(i);
    levels_.bindLevel(i, index);
    runner_.runGroups(*programs[i], name, across, (blocks + across - 1) / across);
  }
}

// The cloths side by side, level by level. The last row of a cloth, in which work groups count themselves, is
// alone: there is one such count.
void GpuExecutor::runRestrictions(const StagePrograms& programs, const std::string& name) {
  const auto lanes = static_cast<std::uint32_t>(options_.coarseLanes);
  const auto run = [&](std::size_t i, std::size_t level) {
    levels_.bindRow(i, level);
    runner_.runGroups(*programs[i], name, (levels_.ofPiece(i)[level].coarseCount + lanes - 1) / lanes);
  };
  for (std::size_t level = 0; level + 1 < levels_.mostRows(); ++level) {
    const PassRunner::SideBySide cloths(runner_);
    for (std::size_t i = 0; i < programs.size(); ++i)
      if (level + 1 < levels_.rowsOf(i)) run(i, level);
  }
  for (std::size_t i = 0; i < programs.size(); ++i)
    if (levels_.rowsOf(i) > 0) run(i, levels_.rowsOf(i) - 1);
}

void GpuExecutor::runProlongations(const StagePrograms& programs, const std::string& name) {
  for (std::size_t level = levels_.mostRows(); level-- > 1;) {
    const PassRunner::SideBySide cloths(runner_);
    for (std::size_t i = 0; i < programs.size(); ++i) {
      if (level >= levels_.rowsOf(i)) continue;
      levels_.bindLevel(i, level);
      runOnEntries(*programs[i], name, levels_.ofPiece(i)[level].fineCount);
    }
  }
}

void GpuExecutor::flush() {
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (watch_.isPublished()) return;
  // What the host will ask about these steps is on its way to it while it does other things.
  surfaceContact_.publish();
  watch_.publish();  // with a mark behind both
}

void GpuExecutor::finish() {
  glFinish();
  gl::checkErrors("the steps on the GPU");
}

void GpuExecutor::forgetDivergence(std::uint64_t step) {
  watch_.forget(step);
  selfCollision_.forgetDivergence();
}

std::optional<Divergence> GpuExecutor::findDivergence(std::uint64_t step, bool wait) {
  if (watch_.found() || !wait) return watch_.found();
  gl::checkContext();
  if (!watch_.isPublished()) flush();
  const std::optional<Divergence> found = watch_.find(step - 1);
  lackedRoom_ = surfaceContact_.makeRoom();
  return found;
}

void GpuExecutor::keepCounts() {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  surfaceContact_.keepCounts();
  arrays_.keepCounts();
}

void GpuExecutor::restoreCounts() {
  seen_.reset();
  surfaceContact_.restoreCounts();
  arrays_.restoreCounts();
}

ConvergenceCounts GpuExecutor::convergenceCounts() { return convergenceOf(arrays_.scalars()); }

void GpuExecutor::startTiming() { runner_.startTiming(); }

std::vector<PassTime> GpuExecutor::stopTiming() { return runner_.stopTiming(); }

std::string GpuExecutor::device() const {
  const gl::ContextInfo info = gl::currentContextInfo();
  return info.renderer + ", OpenGL " + std::to_string(info.major) + "." + std::to_string(info.minor);
}

}  // namespace clothsim
