#include "solver/gpu/surface_contact.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "shared/step_params.h"
#include "solver/gpu/pass_programs.h"

namespace clothsim {
namespace {

constexpr std::size_t PAIR_TEXELS = 4, BOX_TEXELS = 3, SLIP_TEXELS = 2;

std::uint32_t blocksOf(std::size_t size) {
  return static_cast<std::uint32_t>((size + SURFACE_BLOCK - 1) / SURFACE_BLOCK);
}

// Two rows of 16 bytes a triangle; with seams behind all of them one more each, the joints of its corners.
std::vector<std::uint32_t> triangleRows(const ClothSurface<float>& surface) {
  static_assert(sizeof(SurfaceTriangle) == 8 * sizeof(std::uint32_t));
  const auto* numbers = reinterpret_cast<const std::uint32_t*>(surface.triangles.data());
  std::vector<std::uint32_t> rows(numbers, numbers + 8 * surface.triangles.size());
  if (surface.joints.empty()) return rows;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const auto [a, b, c] = surface.jointsOf(triangle);
    rows.insert(rows.end(), {a, b, c, 0});
  }
  return rows;
}

}  // namespace

GpuSurfaceContact::Numbers::Numbers(const std::string& label, std::size_t count, GLenum format) {
  const std::size_t numbersATexel = format == GL_RGBA32UI ? 4 : 1;
  checkFits(count / numbersATexel, numbersATexel * sizeof(std::uint32_t), label.c_str());
  buffer = gl::Buffer<std::uint32_t>(label, count);
  texture = gl::BufferTexture(label, buffer.name(), format);
}

const gl::Program& GpuSurfaceContact::program(const char* pass, const Variant& variant) {
  auto found = programs_.find({pass, variant});
  if (found == programs_.end()) {
    PassFeatures features = colliderFeatures_;
    features.groupColumns = SURFACE_GROUP;
    features.groupRows = 1;
    features.gate = variant.gate;
    gl::Defines defines = definesFor(features);
    for (const auto& define : gl::Defines{{"SEARCHES_TOUCHING", std::to_string(variant.touching)},
                                          {"WRITES_PAIRS", std::to_string(variant.writes)},
                                          {"SCANS_LISTS", std::to_string(variant.lists)},
                                          {"LATER", std::to_string(variant.later)},
                                          {"ONLY_BOXES", std::to_string(variant.onlyBoxes)},
                                          {"ONLY_COUNTS", std::to_string(variant.counts)},
                                          {"STOPS_SLIPS", std::to_string(variant.stops)}})
      defines.push_back(define);
    gl::Program made = gl::Program::makeCompute("sim/surface/" + std::string(pass) + ".comp", defines);
    found = programs_.emplace(std::pair{std::string_view(pass), variant}, std::move(made)).first;
  }
  return found->second;
}

void GpuSurfaceContact::compile() {
  for (const bool touching : {false, true})
    for (const char* pass : {"start", "boxes"}) program(pass, {.touching = touching});
  program("start", {.touching = true, .later = true});
  for (const char* pass : {"start", "boxes"}) program(pass, {.onlyBoxes = true});
  for (const bool writes : {false, true}) program("search", {.touching = true, .writes = writes});
  for (const bool lists : {false, true}) program("scan", {.lists = lists});
  for (const char* pass : {"list", "sort_lists", "recall", "keep_slips", "guard", "shorten", "settle"})
    program(pass);
  program("weigh", {.gate = GATE_STEP});
  program("multiply_pairs", {.gate = GATE_SYSTEM});
  if (surface_.colliders.empty()) return;
  program("meet", {.gate = GATE_STEP});
  for (const bool counts : {false, true}) program("press", {.counts = counts});
  program("press", {.stops = true});
  for (const bool stops : {false, true}) program("press_particles", {.stops = stops});
}

void GpuSurfaceContact::setSurface(ClothSurface<float> surface, std::uint32_t particles,
                                   const PassFeatures& features) {
  const std::uint32_t room = surface_.roomForPairs;
  surface_ = std::move(surface);
  surface_.roomForPairs = std::min(std::max(room, surface_.roomForPairs), surface_.pairLimit);
  particles_ = particles;
  PassFeatures known = restricted(features, {Feature::smallColliders});
  if (known.smallColliders) known = restricted(features, {Feature::smallColliders, Feature::colliders});
  if (known != colliderFeatures_) programs_.clear();
  colliderFeatures_ = known;
  compile();
  const std::size_t triangles = surface_.triangles.size();
  const std::vector<std::uint32_t> rows = triangleRows(surface_);
  triangles_ = Numbers("surface triangles", rows.size(), GL_RGBA32UI);
  triangles_.buffer.upload(rows);
  points_ = ParticleArray("surface points", particles);
  static_assert(sizeof(SurfacePoint<float>) == sizeof(Particle4));
  points_.buffer.upload({reinterpret_cast<const Particle4*>(surface_.points.data()), particles});
  rings_ = Numbers("rings of particles", surface_.rings.size());
  rings_.buffer.upload(surface_.rings);
  static_assert(sizeof(SurfaceBlock) == 12 * sizeof(std::uint32_t));
  const std::size_t blocks = surface_.blocks.size();
  flatBlocks_ = Numbers("blocks of grids", 12 * std::max<std::size_t>(blocks, 1), GL_RGBA32UI);
  if (blocks > 0)
    flatBlocks_.buffer.upload({reinterpret_cast<const std::uint32_t*>(surface_.blocks.data()), 12 * blocks});
  flatSides_ = ParticleArray("sides of blocks", 4 * std::max<std::size_t>(blocks, 1));
  flatFlags_ = Numbers("flat blocks", std::max<std::size_t>(blocks, 1));
  smallColliders_ = ParticleArray("small colliders", 2 * std::max<std::size_t>(surface_.colliders.size(), 1));
  static_assert(sizeof(SmallCollider<float>) == 2 * sizeof(Particle4));
  smallColliders_.buffer.upload(
      {reinterpret_cast<const Particle4*>(surface_.colliders.data()), 2 * surface_.colliders.size()});
  boxes_ = ParticleArray("boxes", BOX_TEXELS * surface_.firstBoxes.back());
  counts_ = Numbers("pairs by triangle", triangles);
  blocks_ = Numbers("blocks of triangles", blocksOf(triangles));
  lists_ = Numbers("pairs by particle", particles);
  listBlocks_ = Numbers("blocks of particles", blocksOf(particles));
  cursors_ = gl::Buffer<std::uint32_t>("list cursors", particles);
  kept_ = gl::Buffer<std::uint32_t>("kept motions", std::size_t{2} * particles);
  corrections_ = gl::Buffer<std::int32_t>("corrections", std::size_t{4} * particles);
  safePositions_ = ParticleArray("safe positions", particles);
  safeVelocities_ = ParticleArray("safe velocities", particles);
  if (state_.name() == 0) {
    const SurfaceState fresh = freshSurfaceState();
    state_ = gl::Buffer<SurfaceState>("surface state", std::span(&fresh, 1));
    stateCopy_ = gl::MappedBuffer<SurfaceState>("what the surface has counted", 1);
    const std::vector<Groups> none(1, Groups{0, 1, 1});
    dispatches_ = gl::Buffer<Groups>("pair dispatches", std::span<const Groups>(none));
    params_ = gl::Buffer<SurfaceParams>("surface parameters", 1);
  }
  std::vector<RoundSlot> rounds;
  for (std::uint32_t round = 0; round < GUARD_ROUNDS; ++round) rounds.push_back({{round, 0, 0, 0}});
  rounds_ = gl::Buffer<RoundSlot>("rounds of the guard", std::span<const RoundSlot>(rounds));
  allocatePairs(surface_.roomForPairs);
  uploadParams();
  isOn_ = true;
}

void GpuSurfaceContact::switchOff() {
  setSlips({});
  isOn_ = false;
}

// What friction remembers stays.
void GpuSurfaceContact::allocatePairs(std::size_t pairs) {
  const std::size_t room = std::max(pairs, pairIds_.buffer.size() / 4);
  const auto grow = [&](Numbers& numbers, const char* label, std::size_t texels) {
    Numbers larger(label, 4 * texels * room, GL_RGBA32UI);
    if (numbers.buffer.name() != 0) larger.buffer.copyFrom(numbers.buffer);
    numbers = std::move(larger);
  };
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  grow(pairIds_, "pair particles", 1);
  grow(newSlips_, "new elastic slips of pairs", SLIP_TEXELS);
  keptIds_ = Numbers("pair particles before", 4 * room, GL_RGBA32UI);
  keptSlips_ = Numbers("elastic slips of pairs before", 4 * SLIP_TEXELS * room, GL_RGBA32UI);
  pairSlips_ = Numbers("elastic slips of pairs", 4 * SLIP_TEXELS * room, GL_RGBA32UI);
  pairRows_ = ParticleArray("pairs", PAIR_TEXELS * room);
  pairCarries_ = ParticleArray("pair carries", room);
  entries_ = Numbers("pair lists", 4 * room);
}

void GpuSurfaceContact::uploadParams() {
  SurfaceParams params{};
  params.triangles = static_cast<std::uint32_t>(surface_.triangles.size());
  params.topLevel = static_cast<int>(surface_.firstBoxes.size()) - 2;
  params.roomForPairs = surface_.roomForPairs;
  params.around = surface_.around;
  params.margin = surface_.margin;
  params.largestPush = surface_.largestPush;
  params.leastGap = surface_.leastGap;
  params.quantum = surface_.quantum;
  params.perQuantum = surface_.perQuantum;
  params.touchingReach = surface_.touchingReach;
  params.blocks = static_cast<std::uint32_t>(surface_.blocks.size());
  params.isOneGrid = surface_.isOneGrid ? 1 : 0;
  params.touchesItself = surface_.touchesItself ? 1 : 0;
  params.smallColliders = static_cast<std::uint32_t>(surface_.colliders.size());
  for (std::size_t level = 0; level < surface_.firstBoxes.size(); ++level)
    params.firstBoxes[level][0] = surface_.firstBoxes[level];
  params_.upload({&params, 1});
}

void GpuSurfaceContact::publish() {
  if (!isOn()) return;
  stateCopy_.copyFrom(state_, 0, 1);
  hasCopy_ = isCopyCurrent_ = true;
}

bool GpuSurfaceContact::makeRoom() {
  if (!isOn() || !hasCopy_) return false;
  const SurfaceState& counted = stateCopy_.elements().front();
  if (isCopyCurrent_) knownPairs_ = counted.pairs;
  const std::uint32_t room = surface_.roomForPairs, limit = surface_.pairLimit;
  if (counted.mostPairs <= room / 2 || room == limit) return false;
  surface_.roomForPairs = counted.mostPairs < limit / 2 ? 2 * counted.mostPairs : limit;
  allocatePairs(surface_.roomForPairs);
  uploadParams();
  return counted.mostPairs > room;
}

void GpuSurfaceContact::keepCounts() {
  if (!isOn()) return;
  if (keptState_.name() == 0) keptState_ = gl::Buffer<SurfaceState>("kept surface state", 1);
  keptState_.copyFrom(state_);
}

void GpuSurfaceContact::restoreCounts() {
  if (isOn()) state_.copyFrom(keptState_);
}

void GpuSurfaceContact::bindTextures() const {
  if (!isOn()) return;
  triangles_.texture.bind(SURFACE_TRIANGLES_UNIT);
  points_.texture.bind(SURFACE_POINTS_UNIT);
  rings_.texture.bind(SURFACE_RINGS_UNIT);
  boxes_.texture.bind(SURFACE_BOXES_UNIT);
  bindSlips();
  pairRows_.texture.bind(PAIR_ROWS_UNIT);
  lists_.texture.bind(PAIR_STARTS_UNIT);
  listBlocks_.texture.bind(PAIR_BLOCKS_UNIT);
  entries_.texture.bind(PAIR_ENTRIES_UNIT);
  blocks_.texture.bind(SURFACE_BLOCKS_UNIT);
  flatBlocks_.texture.bind(FLAT_BLOCKS_UNIT);
  flatSides_.texture.bind(FLAT_SIDES_UNIT);
  flatFlags_.texture.bind(FLAT_FLAGS_UNIT);
  smallColliders_.texture.bind(SMALL_COLLIDERS_UNIT);
  pairCarries_.texture.bind(PAIR_CARRIES_UNIT);
}

void GpuSurfaceContact::bindSlips() const {
  pairIds_.texture.bind(PAIR_IDS_UNIT);
  pairSlips_.texture.bind(PAIR_SLIPS_UNIT);
  keptIds_.texture.bind(KEPT_IDS_UNIT);
  keptSlips_.texture.bind(KEPT_SLIPS_UNIT);
}

std::vector<PairSlip> GpuSurfaceContact::Slips::download() const {
  if (ids.name() == 0) return {};
  const std::size_t pairs = state.download().front().pairs;
  const std::vector<std::uint32_t> particles = ids.download(0, 4 * pairs),
                                   rows = slips.download(0, 4 * SLIP_TEXELS * pairs);
  std::vector<PairSlip> result(pairs);
  for (std::size_t q = 0; q < pairs; ++q) {
    const std::uint32_t *p = particles.data() + 4 * q, *row = rows.data() + 4 * SLIP_TEXELS * q;
    const auto number = [&](std::size_t k) { return std::bit_cast<float>(row[k]); };
    result[q] = {row[3], {p[0], p[1], p[2], p[3]}, number(0), number(1), number(2), number(4)};
  }
  return result;
}

void GpuSurfaceContact::copySlips(Slips& copy) const {
  if (!isOn()) {
    copy = {};
    return;
  }
  const std::size_t pairs = knownPairs_.value_or(pairIds_.buffer.size() / 4);
  if (copy.state.name() == 0 || copy.ids.size() < 4 * pairs || copy.ids.size() > 8 * pairs) {
    copy.ids = gl::Buffer<std::uint32_t>("kept pairs", 4 * pairs);
    copy.slips = gl::Buffer<std::uint32_t>("kept elastic slips of pairs", 4 * SLIP_TEXELS * pairs);
    copy.state = gl::Buffer<SurfaceState>("kept number of pairs", 1);
  }
  copy.ids.copyFrom(pairIds_.buffer, 4 * pairs);
  copy.slips.copyFrom(newSlips_.buffer, 4 * SLIP_TEXELS * pairs);
  copy.state.copyFrom(state_);
}

void GpuSurfaceContact::restoreSlips(const Slips& copy) {
  if (!isOn() || copy.ids.name() == 0) return setSlips(copy.download());
  forgetPairCount();
  if (copy.ids.size() > pairIds_.buffer.size()) allocatePairs(copy.ids.size() / 4);
  pairIds_.buffer.copyFrom(copy.ids);
  newSlips_.buffer.copyFrom(copy.slips);
  constexpr auto place = static_cast<GLintptr>(offsetof(SurfaceState, pairs));
  glCopyNamedBufferSubData(copy.state.name(), state_.name(), place, place, sizeof(SurfaceState::pairs));
}

// The copy of what has been counted is of before.
void GpuSurfaceContact::forgetPairCount() {
  isCopyCurrent_ = false;
  knownPairs_.reset();
}

void GpuSurfaceContact::setSlips(const std::vector<PairSlip>& slips) {
  forgetPairCount();
  if (!isOn()) return;
  std::vector<std::uint32_t> particles, rows;
  for (const PairSlip& slip : slips) {
    particles.insert(particles.end(), slip.particles.begin(), slip.particles.end());
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    rows.insert(rows.end(),
                {bits(slip.x), bits(slip.y), bits(slip.z), slip.place, bits(slip.heldLimit), 0, 0, 0});
  }
  if (particles.size() > pairIds_.buffer.size()) allocatePairs(slips.size());
  pairIds_.buffer.upload(particles);
  newSlips_.buffer.upload(rows);
  const auto pairs = static_cast<std::uint32_t>(slips.size());
  glNamedBufferSubData(state_.name(), offsetof(SurfaceState, pairs), sizeof pairs, &pairs);
}

void GpuSurfaceContact::runOn(PassRunner& runner, const gl::Program& program, std::size_t entries) const {
  runner.runGroups(program, name_, static_cast<std::uint32_t>((entries + SURFACE_GROUP - 1) / SURFACE_GROUP));
}

// The boxes of triangles, and what a search begins with.
void GpuSurfaceContact::start(PassRunner& runner, const Variant& variant) {
  const auto groupsFor = [](std::size_t entries) { return (entries + SURFACE_GROUP - 1) / SURFACE_GROUP; };
  boxes_.buffer.bindStorage(SURFACE_OUT_BINDING);
  std::size_t groups = 0;
  if (surface_.touchesItself)
    groups += groupsFor((surface_.triangles.size() + BOX_CHILDREN - 1) / BOX_CHILDREN);
  if (!variant.onlyBoxes) {
    flatSides_.buffer.bindStorage(SURFACE_IDS_BINDING);
    (variant.touching ? cursors_ : kept_).bindStorage(SURFACE_COUNTS_BINDING);
    if (variant.touching)
      lists_.buffer.bindStorage(SURFACE_LISTS_BINDING);
    else
      corrections_.bindStorage(SURFACE_LISTS_BINDING);
    if (surface_.touchesItself) groups += groupsFor(surface_.blocks.size());
    groups += groupsFor(particles_);
  }
  const auto row = static_cast<std::uint32_t>(GROUPS_A_ROW), count = static_cast<std::uint32_t>(groups);
  runner.runGroups(program("start", variant), name_, std::min(count, row), (count + row - 1) / row);
  if (surface_.touchesItself) joinBoxes(runner, variant);
}

// The levels above those that start() has made, and which blocks are flat.
void GpuSurfaceContact::joinBoxes(PassRunner& runner, const Variant& variant) {
  const auto groupsFor = [](std::size_t entries) { return (entries + SURFACE_LANES - 1) / SURFACE_LANES; };
  const std::vector<std::uint32_t>& first = surface_.firstBoxes;
  constexpr std::size_t level = 2;
  std::size_t groups = level + 1 < first.size() ? groupsFor(first[level + 1] - first[level]) : 0;
  if (!variant.onlyBoxes) {
    flatFlags_.buffer.bindStorage(SURFACE_IDS_BINDING);
    groups += groupsFor(surface_.blocks.size());
  }
  const Variant own{.touching = variant.touching, .onlyBoxes = variant.onlyBoxes};
  runner.runGroups(program("boxes", own), name_, static_cast<std::uint32_t>(groups));
}

void GpuSurfaceContact::scan(PassRunner& runner, Numbers& counts, Numbers& blocks, std::size_t size,
                             bool lists) {
  counts.buffer.bindStorage(SURFACE_COUNTS_BINDING);
  blocks.buffer.bindStorage(SURFACE_OUT_BINDING);
  dispatches_.bindStorage(SURFACE_IDS_BINDING);
  runner.runGroups(program("scan", {.lists = lists}), name_, blocksOf(size));
}

void GpuSurfaceContact::findTouching(PassRunner& runner, bool later) {
  const std::size_t triangles = surface_.triangles.size();
  if (!later) {
    std::swap(pairIds_, keptIds_);
    std::swap(newSlips_, keptSlips_);
    bindSlips();
  }
  start(runner, {.touching = true, .later = later});
  counts_.buffer.bindStorage(SURFACE_COUNTS_BINDING);
  runOn(runner, program("search", {.touching = true}), triangles);
  scan(runner, counts_, blocks_, triangles, false);

  lists_.buffer.bindStorage(SURFACE_LISTS_BINDING);
  pairIds_.buffer.bindStorage(SURFACE_IDS_BINDING);
  pairRows_.buffer.bindStorage(SURFACE_OUT_BINDING);
  pairSlips_.buffer.bindStorage(PAIR_SLIPS_BINDING);
  runOn(runner, program("search", {.touching = true, .writes = true}), triangles);
  scan(runner, lists_, listBlocks_, particles_, true);

  runner.takeCounts(dispatches_);
  cursors_.bindStorage(SURFACE_OUT_BINDING);
  entries_.buffer.bindStorage(SURFACE_LISTS_BINDING);
  runner.runIndirect(program("list"), name_, 0);
  runOn(runner, program("sort_lists"), particles_);
  pairCarries_.buffer.bindStorage(SURFACE_CARRIES_BINDING);
  pairSlips_.buffer.bindStorage(PAIR_SLIPS_BINDING);
  runner.runIndirect(program("recall"), name_, 0);
  meetColliders(runner);
}

void GpuSurfaceContact::meetColliders(PassRunner& runner) {
  if (surface_.colliders.empty()) return;
  dispatches_.bindDispatches();
  pairRows_.buffer.bindStorage(SURFACE_OUT_BINDING);
  pairCarries_.buffer.bindStorage(SURFACE_CARRIES_BINDING);
  runner.runIndirect(program("meet", {.gate = GATE_STEP}), name_, 0);
}

void GpuSurfaceContact::pressOut(PassRunner& runner, GpuArrays& arrays, std::uint32_t round) {
  dispatches_.bindDispatches();
  pairRows_.buffer.bindStorage(SURFACE_OUT_BINDING);
  runner.runIndirect(program("press", {.counts = round == PRESS_ROUNDS, .stops = round == 0}), name_, 0);
  if (round == PRESS_ROUNDS) return;
  bindEnds(arrays);
  runOn(runner, program("press_particles", {.stops = round == 0}), particles_);
}

void GpuSurfaceContact::guard(PassRunner& runner, GpuArrays& arrays, std::uint32_t round) {
  if (round == 0) start(runner, {});
  if (round == CORRECTION_ROUNDS) start(runner, {.onlyBoxes = true});
  bindEnds(arrays);
  kept_.bindStorage(SURFACE_COUNTS_BINDING);
  corrections_.bindStorage(SURFACE_LISTS_BINDING);
  cursors_.bindStorage(SURFACE_MOVED_BINDING);  // which hold nothing by then
  rounds_.bindUniformRange(GUARD_ROUND_BINDING, round, 1);
  runOn(runner, program("guard"), surface_.triangles.size());
}

void GpuSurfaceContact::bindEnds(GpuArrays& arrays) const {
  arrays[Array::newPositions].buffer.bindStorage(NEW_POSITIONS_BINDING);
  arrays[Array::newVelocities].buffer.bindStorage(NEW_VELOCITIES_BINDING);
}

void GpuSurfaceContact::shorten(PassRunner& runner, GpuArrays& arrays) {
  bindEnds(arrays);
  kept_.bindStorage(SURFACE_LISTS_BINDING);
  safeVelocities_.buffer.bindStorage(SURFACE_COUNTS_BINDING);
  runOn(runner, program("shorten"), particles_);
}

void GpuSurfaceContact::settle(PassRunner& runner, GpuArrays& arrays) {
  safePositions_.buffer.bindStorage(SURFACE_OUT_BINDING);
  arrays[Array::displacements].buffer.bindStorage(SURFACE_LISTS_BINDING);
  arrays[Array::iterates].buffer.bindStorage(SURFACE_IDS_BINDING);
  arrays[Array::newVelocities].buffer.bindStorage(SURFACE_VELOCITIES_BINDING);
  safeVelocities_.buffer.bindStorage(SURFACE_COUNTS_BINDING);
  runOn(runner, program("settle"), particles_);
  safePositions_.texture.bind(SURFACE_STARTS_UNIT);
}

void GpuSurfaceContact::run(PassRunner& runner, PassCall call, GpuArrays& arrays) {
  name_ = runner.isTiming() ? nameOf(call.pass) : "";
  forgetPairCount();
  arrays.bindFor(call.pass);
  arrays.bindScalars();
  params_.bindUniform(SURFACE_PARAMS_BINDING);
  state_.bindStorage(SURFACE_STATE_BINDING);
  switch (call.pass) {
    case Pass::findTouching:
      if (call.index == 0) arrays[Array::positions].texture.bind(SURFACE_STARTS_UNIT);
      return findTouching(runner, call.index > 0);
    case Pass::weighPairs:
    case Pass::multiplyPairs:
      if (call.pass == Pass::weighPairs) meetColliders(runner);
      dispatches_.bindDispatches();
      pairRows_.buffer.bindStorage(SURFACE_OUT_BINDING);
      return runner.runIndirect(call.pass == Pass::weighPairs
                                    ? program("weigh", {.gate = GATE_STEP})
                                    : program("multiply_pairs", {.gate = GATE_SYSTEM}),
                                name_, 0);
    case Pass::keepSlips:
      dispatches_.bindDispatches();
      newSlips_.buffer.bindStorage(SURFACE_OUT_BINDING);
      return runner.runIndirect(program("keep_slips"), name_, 0);
    case Pass::pressOut:
      return pressOut(runner, arrays, call.index);
    case Pass::guard:
      return guard(runner, arrays, call.index);
    case Pass::settle:
      return settle(runner, arrays);
    default:
      assert(call.pass == Pass::shorten && "this pass is one of surface contact");
      shorten(runner, arrays);
  }
}

ContactCounts GpuSurfaceContact::counts() const {
  if (state_.name() == 0) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return countsOf(state_.download().front());
}

void GpuSurfaceContact::forgetCounts() {
  if (state_.name() == 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<SurfaceState> state = state_.download();
  clothsim::forgetCounts(state.front());
  state_.upload(state);
}

}  // namespace clothsim
