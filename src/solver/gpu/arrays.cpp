#include "solver/gpu/arrays.h"

#include <string>
#include <utility>

#include "shared/implicit.h"
#include "shared/step_params.h"

namespace clothsim {
namespace {

constexpr std::size_t FACTOR_TEXELS = 2, AIR_TEXELS = 2, PLANE_TEXELS = 2, HISTORY_TEXELS = 2;

}  // namespace

ArrayPlace placeOf(Array array) {
  switch (array) {
    case Array::positions:
      return {STARTS_UNIT, -1};
    case Array::velocities:
      return {VELOCITIES_UNIT, -1};
    case Array::newPositions:
      return {NEW_POSITIONS_UNIT, NEW_POSITIONS_BINDING};
    case Array::newVelocities:
      return {NEW_VELOCITIES_UNIT, NEW_VELOCITIES_BINDING};
    case Array::forces:
      return {-1, FORCES_BINDING};
    case Array::planes:
      return {CONTACT_PLANES_UNIT, CONTACT_PLANES_BINDING};
    case Array::contactBlocks:
      return {CONTACT_BLOCKS_UNIT, CONTACT_BLOCKS_BINDING};
    case Array::elasticSlips:
      return {ELASTIC_SLIPS_UNIT, -1};
    case Array::newElasticSlips:
      return {-1, NEW_ELASTIC_SLIPS_BINDING};
    case Array::histories:
      return {HISTORIES_UNIT, HISTORIES_BINDING};
    case Array::rightHandSides:
      return {RIGHT_HAND_SIDES_UNIT, RIGHT_HAND_SIDES_BINDING};
    case Array::airBlocks:
      return {AIR_BLOCKS_UNIT, AIR_BLOCKS_BINDING};
    case Array::displacements:
      return {DISPLACEMENTS_UNIT, DISPLACEMENTS_BINDING};
    case Array::iterates:
      return {ITERATES_UNIT, ITERATES_BINDING};
    case Array::residuals:
      return {RESIDUALS_UNIT, RESIDUALS_BINDING};
    case Array::corrections:
      return {CORRECTIONS_UNIT, CORRECTIONS_BINDING};
    case Array::factors:
      return {FACTORS_UNIT, FACTORS_BINDING};
    case Array::centers:
      return {CENTERS_UNIT, CENTERS_BINDING};
    case Array::coarseBlocks:
      return {COARSE_BLOCKS_UNIT, COARSE_BLOCKS_BINDING};
    case Array::coarseInverses:
      return {COARSE_INVERSES_UNIT, COARSE_INVERSES_BINDING};
    case Array::dense:
      return {DENSE_UNIT, DENSE_BINDING};
    case Array::directions:
      return {DIRECTIONS_UNIT, DIRECTIONS_BINDING};
    case Array::products:
      return {PRODUCTS_UNIT, PRODUCTS_BINDING};
    case Array::increments:
      return {INCREMENTS_UNIT, INCREMENTS_BINDING};
    case Array::partialSums:
      return {-1, PARTIAL_SUMS_BINDING};
    case Array::scalars:
      return {-1, SCALARS_BINDING};
    case Array::watch:
      return {-1, WATCH_BINDING};
    case Array::hash:
    case Array::candidates:
    case Array::contactFlags:
    case Array::touching:
    case Array::pairForces:
    case Array::pairSlips:
    case Array::newPairSlips:
    case Array::keptMotions:
    case Array::safePositions:
      return {};  // in buffers of self-collision's and surface contact's own
  }
  return {};
}

Array positionsOf(Pass pass) {
  switch (pass) {
    case Pass::elasticForces:
    case Pass::linearize:
      return Array::iterates;
    case Pass::multiply:
      return Array::directions;
    default:
      return Array::positions;
  }
}

GpuArrays::GpuArrays(std::size_t particles) {
  checkFits(particles, sizeof(Particle4), "particles");
  for (const Array array :
       {Array::positions, Array::velocities, Array::newPositions, Array::newVelocities, Array::forces})
    (*this)[array] = ParticleArray(std::string(nameOf(array)), particles);
}

void GpuArrays::addImplicit(std::size_t particles, const GpuLevels& levels, bool wind, bool colliders,
                            bool history) {
  const auto add = [&](Array array, std::size_t texels) {
    if ((*this)[array].buffer.name() != 0 && (*this)[array].buffer.size() >= texels) return false;
    (*this)[array] = ParticleArray(std::string(nameOf(array)), texels);
    // What pressed in the step before is compared with what does now: before the first one nothing did.
    if (array == Array::contactBlocks || array == Array::elasticSlips) (*this)[array].buffer.clear();
    return true;
  };
  for (const Array array : {Array::rightHandSides, Array::displacements, Array::iterates, Array::directions,
                            Array::products, Array::increments})
    add(array, particles);
  addSpare(Array::directions);
  const std::size_t entries = particles + VERTEX_TEXELS * std::size_t{levels.vertices()};
  add(Array::residuals, entries);
  add(Array::corrections, entries);
  add(Array::factors, FACTOR_TEXELS * particles);
  add(Array::centers, levels.vertices());
  add(Array::coarseBlocks, BLOCK_TEXELS * levels.blocks());
  add(Array::coarseInverses, BLOCK_TEXELS * std::size_t{levels.vertices()});
  if (add(Array::dense, (std::size_t{levels.denseEntries()} + 3) / 4)) {
    checkTexelsFit(levels.denseEntries(), "numbers of dense inverses");
    ParticleArray& dense = (*this)[Array::dense];
    dense.texture = gl::BufferTexture("dense", dense.buffer.name(), GL_R32F);  // a number a texel
  }
  add(Array::airBlocks, wind ? AIR_TEXELS * particles : 1);
  add(Array::planes, colliders ? PLANE_TEXELS * particles : 1);
  add(Array::contactBlocks, colliders ? PLANE_TEXELS * particles : 1);
  for (const Array array : {Array::elasticSlips, Array::newElasticSlips})
    add(array, colliders ? particles : 1);
  add(Array::histories, history ? HISTORY_TEXELS * particles : 1);
  add(Array::partialSums, (particles + SUM_BLOCK - 1) / SUM_BLOCK);
  const ImplicitScalars<float> none{};
  if (scalars_.name() == 0)
    scalars_ = gl::Buffer<ImplicitScalars<float>>("implicit scalars", std::span(&none, 1));
}

void GpuArrays::setElasticSlips(const gl::Buffer<Particle4>& slips) {
  ParticleArray& own = (*this)[Array::elasticSlips];
  const bool isThere = slips.name() != 0;
  if (isThere && own.buffer.size() < slips.size())
    own = ParticleArray(std::string(nameOf(Array::elasticSlips)), slips.size());
  if (isThere)
    own.buffer.copyFrom(slips);
  else if (own.buffer.name() != 0)
    own.buffer.clear();
}

namespace {

constexpr GLintptr USUAL_STEPS_OFFSET = offsetof(ImplicitScalars<float>, usualSteps);

}  // namespace

void GpuHistory::download(State& state) const {
  clothsim::forgetHistory(state);
  if (scalars.name() == 0) return;
  state.usualSteps = std::min(scalars.download().front().usualSteps, USUAL_STEPS);
  if (state.usualSteps > 0) state.histories = changes.download();
}

bool GpuArrays::hasHistory() const {
  return (*this)[Array::histories].buffer.size() == HISTORY_TEXELS * (*this)[Array::positions].buffer.size();
}

void GpuArrays::forgetHistory() { resetScalar(USUAL_STEPS_OFFSET); }

void GpuArrays::forgetPairs() { resetScalar(offsetof(ImplicitScalars<float>, pairs)); }

void GpuArrays::resetScalar(GLintptr offset) {
  static constexpr GLuint none = 0;
  if (scalars_.name() != 0) glNamedBufferSubData(scalars_.name(), offset, sizeof none, &none);
}

void GpuArrays::setHistory(const State& state) {
  if (!hasHistory() || state.histories.size() != (*this)[Array::histories].buffer.size())
    return forgetHistory();
  (*this)[Array::histories].buffer.upload(state.histories);
  glNamedBufferSubData(scalars_.name(), USUAL_STEPS_OFFSET, sizeof state.usualSteps, &state.usualSteps);
}

void GpuArrays::copyHistory(GpuHistory& copy) const {
  if (!hasHistory()) {
    copy = {};
    return;
  }
  const gl::Buffer<Particle4>& own = (*this)[Array::histories].buffer;
  if (copy.changes.size() != own.size())
    copy = {gl::Buffer<Particle4>("kept histories", own.size()),
            gl::Buffer<ImplicitScalars<float>>("kept implicit scalars", std::size_t{1})};
  copy.changes.copyFrom(own);
  copy.scalars.copyFrom(scalars_);
}

void GpuArrays::restoreHistory(const GpuHistory& copy) {
  if (!hasHistory() || copy.changes.name() == 0) return forgetHistory();
  (*this)[Array::histories].buffer.copyFrom(copy.changes);
  glCopyNamedBufferSubData(copy.scalars.name(), scalars_.name(), USUAL_STEPS_OFFSET, USUAL_STEPS_OFFSET,
                           sizeof(GLuint));
}

ImplicitScalars<float> GpuArrays::scalars() const {
  if (scalars_.name() == 0) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return scalars_.download().front();
}

void GpuArrays::keepCounts() {
  if (scalars_.name() == 0) return;
  if (keptScalars_.name() == 0)
    keptScalars_ = gl::Buffer<ImplicitScalars<float>>("kept counts", std::size_t{1});
  keptScalars_.copyFrom(scalars_);
}

void GpuArrays::restoreCounts() {
  if (keptScalars_.name() != 0) scalars_.copyFrom(keptScalars_);
}

void GpuArrays::copyScalars(gl::MappedBuffer<ImplicitScalars<float>>& copy) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy.copyFrom(scalars_, 0, 1);
}

void GpuArrays::bindTextures(bool storageLoads) {
  storageLoads_ = storageLoads;
  if (storageLoads) (*this)[Array::velocities].buffer.bindStorage(VELOCITIES_BINDING);
  for (int i = 0; i < ARRAY_COUNT; ++i) {
    const int unit = placeOf(static_cast<Array>(i)).unit;
    const ParticleArray& array = arrays_[static_cast<std::size_t>(i)];
    if (unit >= 0 && array.buffer.name() != 0) array.texture.bind(static_cast<GLuint>(unit));
  }
}

void GpuArrays::bindFor(Pass pass) const {
  const ParticleArray& positions = (*this)[positionsOf(pass)];
  positions.texture.bind(POSITIONS_UNIT);
  if (storageLoads_) positions.buffer.bindStorage(POSITIONS_BINDING);
  const PassTraits& traits = traitsOf(pass);
  if (traits.gate != Gate::none || (traits.gathers | traits.reads | traits.writes).contains(Array::scalars))
    scalars_.bindStorage(SCALARS_BINDING);
  for (int i = 0; i < ARRAY_COUNT; ++i) {
    const auto array = static_cast<Array>(i);
    const int binding = placeOf(array).binding;
    const bool hasBuffer = (*this)[array].buffer.name() != 0;  // scalars and watch have others
    if (binding >= 0 && traits.writes.contains(array) && hasBuffer)
      (*this)[array].buffer.bindStorage(static_cast<GLuint>(binding));
  }
}

void GpuArrays::addSpare(Array array) {
  ParticleArray& spare = spares_[static_cast<std::size_t>(array)];
  const std::size_t texels = (*this)[array].buffer.size();
  if (spare.buffer.name() == 0 || spare.buffer.size() < texels)
    spare = ParticleArray(std::string(nameOf(array)) + " 2", texels);
}

void GpuArrays::bindSpare(Array array) const {
  spares_[static_cast<std::size_t>(array)].buffer.bindStorage(static_cast<GLuint>(placeOf(array).binding));
}

void GpuArrays::takeSpare(Array array) {
  std::swap((*this)[array], spares_[static_cast<std::size_t>(array)]);
  (*this)[array].texture.bind(static_cast<GLuint>(placeOf(array).unit));
}

}  // namespace clothsim
