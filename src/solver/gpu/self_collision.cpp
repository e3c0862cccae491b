#include "solver/gpu/self_collision.h"

#include <cassert>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "shared/step_params.h"
#include "solver/gpu/pass_programs.h"
#include "solver/tearing.h"

namespace clothsim {
namespace {

std::uint32_t groupsAcross(int invocations, int groupSize) {
  return static_cast<std::uint32_t>((invocations + groupSize - 1) / groupSize);
}

}  // namespace

const gl::Program* GpuSelfCollision::program(const std::string& pass, const Variant& variant) {
  auto found = programs_.find({pass, variant});
  if (found == programs_.end()) {
    PassFeatures features;
    features.cuts = variant.cuts;
    features.seams = variant.seams;
    features.groupColumns = groupColumns_;
    features.groupRows = groupRows_;
    gl::Defines defines = definesFor(features);
    defines.emplace_back("SELF_ROBUST", std::to_string(variant.robust));
    defines.emplace_back("SELF_HAS_MESH", std::to_string(variant.mesh));
    defines.emplace_back("SELF_NEAR_CODES", std::to_string(variant.nearCodes));
    gl::Program made = gl::Program::makeCompute("sim/self/" + pass + ".comp", defines);
    found = programs_.emplace(std::pair{pass, variant}, std::move(made)).first;
  }
  return &found->second;
}

GpuSelfCollision::GpuSelfCollision(const Cloth& cloth, int groupColumns, int groupRows)
    : cloth_(&cloth),
      groupColumns_(cloth.hasMesh() ? groupColumns * groupRows : groupColumns),
      groupRows_(cloth.hasMesh() ? 1 : groupRows) {}

void GpuSelfCollision::configure(const Scene& scene) {
  mode_ = collidesWithItself(scene, *cloth_) ? scene.solver.selfCollision : SelfCollision::off;
  if (!isOn()) return;
  hasNearCodes_ = hasNearCodes(scene, *cloth_);
  canTear_ = canTear(scene);
  choosePrograms();
  SelfParams<float> params = makeSelfParams<float>(scene, *cloth_);
  for (const Piece& piece : cloth_->pieces()) params.gridGroups += gridGroups(piece).count();
  if (params_.name() == 0) allocate(params);
  params_.upload({&params, 1});
  distances_.upload(makeContactDistances<float>(scene, *cloth_));
  restart();
}

// Cuts make neighbours non-adjacent particles, whose distance is that at rest. Passes that look at no pair
// are the same for all of it.
void GpuSelfCollision::choosePrograms() {
  const bool cut = isCut_ || canTear_;
  const Variant any, mode{.robust = isRobust()},
      pairs{isRobust(), hasNearCodes_ || cut, cut, cloth_->hasMesh(), !cloth_->seams().empty()};
  now_.check = program("check", mode);
  now_.count = program("count", any);
  now_.scanBuckets = program("scan_buckets", any);
  now_.scatter = program("scatter", any);
  now_.find = program("find", pairs);
  now_.resolve = program("resolve_contacts", pairs);
  if (!isRobust()) return;
  now_.checkMotion = program("check_motion", pairs);
  now_.clamp = program("clamp_motion", pairs);
}

void GpuSelfCollision::setCut(bool cut) {
  restart();
  if (std::exchange(isCut_, cut) != cut && isOn()) choosePrograms();
}

void GpuSelfCollision::allocate(const SelfParams<float>& params) {
  const std::size_t particles = cloth_->particleCount();
  checkFits(particles * (MOST_CANDIDATES + 1), sizeof(std::uint32_t), "contact candidates");
  params_ = gl::Buffer<SelfParams<float>>("self-collision parameters", 1);
  distances_ = gl::Buffer<float>("contact distances", cloth_->pieces().size() * NEAREST_CODES);
  const Flags none;
  flags_ = gl::Buffer<Flags>("contact flags", std::span<const Flags>(&none, 1));
  const std::vector<std::uint32_t> zeros(std::size_t{params.bucketMask} + 1);
  bucketCounts_ = gl::Buffer<std::uint32_t>("hash bucket counts", std::span<const std::uint32_t>(zeros));
  buckets_ = gl::Buffer<std::uint32_t>("hash buckets", zeros.size());
  bucketBlocks_ = gl::Buffer<std::uint32_t>("hash bucket blocks", params.bucketBlocks);
  candidates_ = gl::Buffer<std::uint32_t>("contact candidates", particles * (MOST_CANDIDATES + 1));
  hashed_ = ParticleArray("hashed positions", particles);
  sorted_ = ParticleArray("sorted particles", particles);
  distancesTexture_ = gl::BufferTexture("contact distances", distances_.name(), GL_R32F);
  bucketsTexture_ = gl::BufferTexture("hash buckets", buckets_.name(), GL_R32UI);
  bucketBlocksTexture_ = gl::BufferTexture("hash bucket blocks", bucketBlocks_.name(), GL_R32UI);
  candidatesTexture_ = gl::BufferTexture("contact candidates", candidates_.name(), GL_R32UI);

  const auto groups = [](std::size_t invocations) {
    return Groups{groupsAcross(static_cast<int>(invocations), HASH_GROUP), 1, 1};
  };
  std::vector<Groups> needed{groups(particles), {params.bucketBlocks, 1, 1}, groups(particles)};
  for (const Piece& piece : cloth_->pieces()) needed.push_back(gridGroups(piece));
  std::vector<Groups> dispatches(needed.size());
  dispatches.insert(dispatches.end(), needed.begin(), needed.end());
  dispatches_ = gl::Buffer<Groups>("hash dispatches", std::span<const Groups>(dispatches));
}

Groups GpuSelfCollision::gridGroups(const Piece& piece) const {
  return {groupsAcross(piece.columns, groupColumns_), groupsAcross(piece.rows, groupRows_), 1};
}

void GpuSelfCollision::restart() {
  if (flags_.name() == 0) return;
  static constexpr GLuint stale = 1;
  glClearNamedBufferSubData(flags_.name(), GL_R32UI, offsetof(Flags, stale), sizeof stale, GL_RED_INTEGER,
                            GL_UNSIGNED_INT, &stale);
}

void GpuSelfCollision::forgetDivergence() {
  if (flags_.name() == 0) return;
  glClearNamedBufferSubData(flags_.name(), GL_R32UI, offsetof(Flags, broken), sizeof(Flags::broken),
                            GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void GpuSelfCollision::bind() const {
  params_.bindUniform(SELF_PARAMS_BINDING);
  flags_.bindStorage(CONTACT_FLAGS_BINDING);
  bucketCounts_.bindStorage(BUCKET_COUNTS_BINDING);
  hashed_.texture.bind(HASHED_POSITIONS_UNIT);
  sorted_.texture.bind(SORTED_UNIT);
  bucketsTexture_.bind(BUCKETS_UNIT);
  bucketBlocksTexture_.bind(BUCKET_BLOCKS_UNIT);
  candidatesTexture_.bind(CANDIDATES_UNIT);
  distancesTexture_.bind(CONTACT_DISTANCES_UNIT);
}

void GpuSelfCollision::runOnPieces(PassRunner& runner, const gl::Program& pass, const std::string& name,
                                   const BindPiece& bindPiece) const {
  const PassRunner::SideBySide cloths(runner);
  for (std::size_t i = 0; i < cloth_->pieces().size(); ++i) {
    const Piece& piece = cloth_->pieces()[i];
    bindPiece(i);
    runner.run(pass, name, static_cast<std::uint32_t>(piece.columns), static_cast<std::uint32_t>(piece.rows));
  }
}

void GpuSelfCollision::buildHash(PassRunner& runner, const std::string& name,
                                 const ParticleArray& positions) const {
  runner.takeCounts(dispatches_);
  positions.texture.bind(POSITIONS_TO_HASH_UNIT);
  hashed_.buffer.bindStorage(HASHED_BINDING);
  runner.runIndirect(*now_.count, name, countPlace);
  buckets_.bindStorage(BUCKETS_BINDING);
  bucketBlocks_.bindStorage(BUCKET_BLOCKS_BINDING);
  runner.runIndirect(*now_.scanBuckets, name, scanBucketsPlace);
  sorted_.buffer.bindStorage(HASHED_BINDING);
  runner.runIndirect(*now_.scatter, name, scatterPlace);
}

void GpuSelfCollision::findCandidates(PassRunner& runner, const std::string& name,
                                      const BindPiece& bindPiece) const {
  candidates_.bindStorage(CANDIDATES_BINDING);
  const PassRunner::SideBySide cloths(runner);
  for (std::size_t piece = 0; piece < cloth_->pieces().size(); ++piece) {
    bindPiece(piece);
    runner.runIndirect(*now_.find, name, findPlace + piece);
  }
}

void GpuSelfCollision::run(PassRunner& runner, PassCall call, GpuArrays& arrays, const BindPiece& bindPiece) {
  const std::string name = runner.isTiming() ? nameOf(call.pass) : "";
  arrays.bindFor(call.pass);
  switch (call.pass) {
    case Pass::checkHash:
      bind();
      dispatches_.bindStorage(DISPATCHES_BINDING);
      return runOnPieces(runner, *now_.check, name, bindPiece);
    case Pass::buildHash:
      return buildHash(runner, name,
                       call.index == HASHES_START ? arrays[Array::positions] : arrays[Array::newPositions]);
    case Pass::findCandidates:
      return findCandidates(runner, name, bindPiece);
    case Pass::resolveContacts:
      // All particles read where the others were before: the new places go into another buffer.
      arrays.bindSpare(Array::newPositions);
      runOnPieces(runner, *now_.resolve, name, bindPiece);
      return arrays.takeSpare(Array::newPositions);
    case Pass::checkMotion:
      dispatches_.bindStorage(DISPATCHES_BINDING);
      return runOnPieces(runner, *now_.checkMotion, name, bindPiece);
    case Pass::clampMotion:
      return runOnPieces(runner, *now_.clamp, name, bindPiece);
    default:
      assert(false && "this pass is not one of self-collision");
  }
}

ContactCounts GpuSelfCollision::counts() const {
  if (flags_.name() == 0) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const Flags flags = flags_.download()[0];
  return {flags.hashBuilds, flags.clampedSteps, flags.fastSteps};
}

void GpuSelfCollision::forgetCounts() {
  if (flags_.name() == 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<Flags> flags = flags_.download();
  flags[0].hashBuilds = flags[0].clampedSteps = flags[0].fastSteps = 0;
  flags_.upload(flags);
}

}  // namespace clothsim
