#include "solver/cpu/self_collision.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>

#include "cloth/cuts.h"
#include "core/exact_math.h"
#include "core/thread_team.h"
#include "core/vec.h"
#include "core/vector_clones.h"
#include "solver/step_params.h"

namespace clothsim::cpu {
namespace {

constexpr std::uint32_t EXCLUDED = ~0u;
constexpr std::uint32_t GROUPS_AT_ONCE = 2;  // of tiles

template <class Real>
View<Real> viewOf(const SelfParams<Real>& params, const CpuState<Real>& before, const CpuState<Real>& after,
                  const Real* fours, const std::vector<Real>& inverseMasses,
                  const std::vector<Real>& distances, const Block& block) {
  const Components<Real>&p0 = before.positions, &p = after.positions;
  return {params,
          p0.x.data(),
          p0.y.data(),
          p0.z.data(),
          p.x.data(),
          p.y.data(),
          p.z.data(),
          fours,
          inverseMasses.data(),
          distances.data() + static_cast<std::size_t>(block.piece) * NEAREST_CODES};
}

}  // namespace

template <class Real>
SelfCollision<Real>::SelfCollision(const Cloth& cloth)
    : cloth_(&cloth), seamNeighbours_(seamNeighbours(cloth)) {
  if (!cloth.hasMesh()) return;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) places_.push_back(startPosition<Real>(cloth, i));
}

template <class Real>
void SelfCollision<Real>::configure(const Scene& scene) {
  mode_ = collidesWithItself(scene, *cloth_) ? scene.solver.selfCollision : clothsim::SelfCollision::off;
  isStale_ = true;
  if (!isOn()) return;
  params_ = makeSelfParams<Real>(scene, *cloth_);
  distances_ = makeContactDistances<Real>(scene, *cloth_);
  hasNearCodes_ = hasNearCodes(scene, *cloth_);
  if (!blocks_.empty()) return;

  const std::size_t count = params_.particles;
  tiles_ = TileSearch<Real>(*cloth_);
  hashedPositions_.resize(count);
  moved_.resize(count);
  fours_.resize(count);
  candidates_.resize(count * MOST_CANDIDATES);
  candidateCounts_.resize(count);
  for (std::uint32_t piece = 0; piece < cloth_->pieces().size(); ++piece) {
    addLatticePlaces(cloth_->pieces()[piece]);
    const std::uint32_t first = cloth_->pieces()[piece].firstParticle;
    const std::uint32_t end = first + cloth_->pieces()[piece].particleCount();
    for (std::uint32_t begin = first; begin < end; begin += BLOCK)
      blocks_.push_back({begin, std::min(begin + BLOCK, end), piece});
  }
}

template <class Real>
void SelfCollision<Real>::addLatticePlaces(const Piece& piece) {
  constexpr Real apart = 16;  // rows between pieces: farther than neighbours are
  const Real firstRow = lattice_.rows.empty() ? 0 : lattice_.rows.back() + apart;
  for (int i = 0; i < static_cast<int>(piece.particleCount()); ++i) {
    const int column = i % piece.columns, row = i / piece.columns;
    lattice_.columns.push_back(static_cast<Real>(column));
    lattice_.rows.push_back(firstRow + static_cast<Real>(row));
  }
}

template <class Real>
void SelfCollision<Real>::setCuts(const Cuts& cuts) {
  cuts_ = cuts;
  cutMasks_ = makeCutMasks(*cloth_, cuts);
  isStale_ = true;
}

// Pairs that are all but one at rest are left alone.
template <class Real>
std::uint32_t SelfCollision<Real>::encodeOnMesh(std::uint32_t i, std::uint32_t j) const {
  const Vec3<Real> d = places_[i] - places_[j];
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real rest = lengthSquared * inverseLength;
  const Real code = params_.codesPerMeter * rest;
  if (!(code < static_cast<Real>(NEAREST_CODES))) return j;
  if (code < Real(1) || (params_.firstCode > 1 && areJoined(cuts_, *cloth_, i, j))) return EXCLUDED;
  return j | static_cast<std::uint32_t>(static_cast<std::int32_t>(code)) << CANDIDATE_BITS;
}

template <class Real>
std::uint32_t SelfCollision<Real>::encode(std::uint32_t number, std::uint32_t i, std::uint32_t j) const {
  if (seamNeighbours_.areNear(i, j)) return EXCLUDED;
  const Piece& piece = cloth_->pieces()[number];
  if (j - piece.firstParticle >= piece.particleCount()) return j;
  if (piece.isMesh) return encodeOnMesh(i, j);
  const int columns = static_cast<int>(lattice_.columns[j] - lattice_.columns[i]),
            rows = static_cast<int>(lattice_.rows[j] - lattice_.rows[i]);
  const auto across = static_cast<std::uint32_t>(std::abs(columns)),
             along = static_cast<std::uint32_t>(std::abs(rows));
  if (across < params_.firstCode && along < params_.firstCode) {
    const bool cut = !cutMasks_.empty() && (cutMasks_[i] >> springWithinCell(columns, rows) & 1u) != 0;
    if (!cut) return EXCLUDED;
  }
  if (across > 7 || along > 7) return j;
  const std::uint32_t code = across + 8 * along;
  return distances_[number * NEAREST_CODES + code] < params_.distance ? j | code << CANDIDATE_BITS : j;
}

template <class Real>
template <class Work>
void SelfCollision<Real>::forEachBlock(Work work) {
  constexpr std::uint32_t blocksAtOnce = 32;
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(blocks_.size()), blocksAtOnce,
                               [&](std::uint32_t k) { work(blocks_[k]); });
}

template <class Real>
template <class Work>
void SelfCollision<Real>::forEachRange(Work work) {
  constexpr std::uint32_t particlesAtOnce = 512;
  ThreadTeam::shared().forEachRange(
      0, params_.particles, particlesAtOnce, [&](std::uint32_t begin, std::uint32_t end) {
        work(Range{static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end)});
      });
}

template <class Real>
void SelfCollision<Real>::buildHash(const CpuState<Real>& state) {
  ++counts_.hashBuilds;
  isStale_ = false;
  hashedPositions_ = state.positions;
  hashedMotion_ = RigidMotion(state.positions, state.velocities);
  stepsSinceHash_ = 0;
}

template <class Real>
void SelfCollision<Real>::findCandidates() {
  tiles_.setPositions(hashedPositions_);
  // Neighbours that a cut parts are candidates.
  const bool neighbors = params_.firstCode < 2 || !cutMasks_.empty();
  overflow_.clear();
  std::mutex ofOverflow;
  std::atomic<bool> lacksMemory = false;  // threads must not throw
  ThreadTeam::shared().forEach(0, tiles_.groups(), GROUPS_AT_ONCE, [&](std::uint32_t group) {
    try {
      thread_local std::vector<Candidate> overflow;
      overflow.clear();
      tiles_.find(
          group, params_.searchSquared, neighbors,
          [&](std::uint32_t tile, std::span<const NearTile> found) { setCandidates(tile, found, overflow); });
      if (overflow.empty()) return;
      const std::lock_guard lock(ofOverflow);
      overflow_.insert(overflow_.end(), overflow.begin(), overflow.end());
    } catch (const std::bad_alloc&) {
      lacksMemory = true;
    }
  });
  if (lacksMemory) throw std::bad_alloc();
  std::ranges::sort(overflow_, {}, [](const Candidate& each) { return std::pair(each.of, each.candidate); });
  forEachBlock([&](Block& block) {
    const auto first = candidateCounts_.begin() + block.begin, end = candidateCounts_.begin() + block.end;
    block.slots = *std::max_element(first, end);
    for (std::uint32_t i = block.begin; i < block.end; ++i)
      for (std::uint32_t slot = candidateCounts_[i]; slot < block.slots; ++slot) candidateAt(slot, i) = i;
  });
}

template <class Real>
void SelfCollision<Real>::setCandidates(std::uint32_t tile, std::span<const NearTile> found,
                                        std::vector<Candidate>& overflow) {
  const std::uint32_t* particles = tiles_.particlesOf(tile);
  for (std::uint32_t k = 0; k < TILE; ++k)
    if (particles[k] != TileSearch<Real>::NOBODY) candidateCounts_[particles[k]] = 0;
  const std::uint32_t piece = tiles_.pieceOf(tile);
  for (const NearTile& other : found)
    for (std::uint32_t k = 0; k < TILE; ++k)
      for (std::uint32_t near = other.near[k]; near != 0; near &= near - 1) {
        const std::uint32_t i = particles[k], j = tiles_.particlesOf(other.tile)[std::countr_zero(near)];
        if (i == j) continue;
        const std::uint32_t candidate = encode(piece, i, j);
        if (candidate == EXCLUDED) continue;
        if (candidateCounts_[i] < MOST_CANDIDATES)
          candidateAt(candidateCounts_[i]++, i) = candidate;
        else
          overflow.push_back({i, candidate});
      }
}

template <class Real>
std::span<const typename SelfCollision<Real>::Candidate> SelfCollision<Real>::overflowOf(
    std::uint32_t begin, std::uint32_t end) const {
  const auto first = std::ranges::lower_bound(overflow_, begin, {}, &Candidate::of);
  return {first, std::ranges::lower_bound(first, overflow_.end(), end, {}, &Candidate::of)};
}

template <class Real>
void SelfCollision<Real>::resolveContacts(const CpuState<Real>& before, CpuState<Real>& after,
                                          const std::vector<Real>& inverseMasses) {
  forEachBlock([&](const Block& block) {
    const View<Real> view =
        viewOf(params_, before, after, fours_.data()->numbers, inverseMasses, distances_, block);
    Sums<Real> sums;
    addContacts(isRobust(), usesNearCodes(), view, candidates_.data(), block, sums);
    for (const auto& [i, candidate] : overflowOf(block.begin, block.end))
      add(sums, i - block.begin,
          isRobust() ? pushOf<true, true>(view, i, candidate) : pushOf<false, true>(view, i, candidate));
    if (std::any_of(sums.count.begin(), sums.count.end(), [](std::uint32_t count) { return count != 0; }))
      moveByContacts(isRobust(), view, block, sums, moved_, after.velocities);
    else
      copyBlock(after.positions, moved_, block);
  });
  std::swap(after.positions, moved_);
}

template <class Real>
void SelfCollision<Real>::checkHash(const CpuState<Real>& before, const CpuState<Real>& after) {
  std::atomic<bool> stale = isStale_, fast = false;
  forEachRange([&](Range particles) {
    putFours(after.positions, particles, fours_.data()->numbers);
    if (!stale && anyMovedFarther(after.positions, hashedPositions_, particles, params_.reuseSquared))
      stale = true;
    if (isRobust() && !fast &&
        anyMovedFarther(after.positions, before.positions, particles, params_.fastSquared))
      fast = true;
  });
  stepsSinceHash_ += 1;
  if (stale && !isStale_) {  // unless the cloth moves as a whole, which brings nothing nearer
    const RigidMap<Real> motion =
        hashedMotion_.after<Real>(stepsSinceHash_ / static_cast<double>(params_.inverseTimeStep));
    stale = false;
    forEachBlock([&](const Block& block) {
      if (!stale && anyLeftMotion(after.positions, hashedPositions_, motion, block, params_.reuseSquared))
        stale = true;
    });
  }
  isStale_ = stale;
  if (fast) ++counts_.fastSteps;
}

template <class Real>
void SelfCollision<Real>::checkMotion(const CpuState<Real>& before, const CpuState<Real>& after,
                                      const std::vector<Real>& inverseMasses) {
  forEachRange([&](Range particles) { putFours(after.positions, particles, fours_.data()->numbers); });
  std::atomic<bool> any = false;
  forEachBlock([&](const Block& block) {
    if (any) return;
    const View<Real> view =
        viewOf(params_, before, after, fours_.data()->numbers, inverseMasses, distances_, block);
    const auto isNear = [&](const Candidate& each) { return tooNear<true>(view, each.of, each.candidate); };
    if (anyTooNear(usesNearCodes(), view, candidates_.data(), block) ||
        std::ranges::any_of(overflowOf(block.begin, block.end), isNear))
      any = true;
  });
  needsClamp_ = any;
  if (any) ++counts_.clampedSteps;
}

template <class Real>
void SelfCollision<Real>::run(PassCall call, const CpuState<Real>& before, CpuState<Real>& after,
                              const std::vector<Real>& inverseMasses) {
  switch (call.pass) {
    case Pass::checkHash:
      return checkHash(before, after);
    case Pass::buildHash:
      // The hash of another step need not know all pairs that were near when this one began: the clamp needs
      // one of its own.
      isRebuilt_ = call.index == HASHES_START ? needsClamp_ : isStale_;
      if (isRebuilt_) buildHash(call.index == HASHES_START ? before : after);
      return;
    case Pass::findCandidates:
      if (isRebuilt_) findCandidates();
      return;
    case Pass::resolveContacts:
      return resolveContacts(before, after, inverseMasses);
    case Pass::checkMotion:
      return checkMotion(before, after, inverseMasses);
    case Pass::clampMotion:
      if (needsClamp_) clampMotion(before, after, inverseMasses);
      return;
    default:
      assert(false && "this pass is not one of self-collision");
  }
}

template <class Real>
void SelfCollision<Real>::clampMotion(const CpuState<Real>& before, CpuState<Real>& after,
                                      const std::vector<Real>& inverseMasses) {
  forEachBlock([&](const Block& block) {
    const View<Real> view =
        viewOf(params_, before, after, fours_.data()->numbers, inverseMasses, distances_, block);
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      const Vec3<Real> x = load(view.x, view.y, view.z, i), start = load(view.x0, view.y0, view.z0, i);
      moved_.x[i] = x.x;
      moved_.y[i] = x.y;
      moved_.z[i] = x.z;
      Real kept = 1;
      const auto look = [&](std::uint32_t candidate) { kept = keptMotion<true>(view, i, candidate, kept); };
      for (std::uint32_t slot = 0; slot < block.slots; ++slot) look(candidateAt(slot, i));
      for (const Candidate& more : overflowOf(i, i + 1)) look(more.candidate);
      if (!(kept < Real(1)) || inverseMasses[i] == Real(0)) continue;
      const Vec3<Real> stopped = start + kept * (x - start);
      const Vec3<Real> kick = params_.inverseTimeStep * (stopped - x);
      Components<Real>& v = after.velocities;
      moved_.x[i] = canonical(stopped.x);
      moved_.y[i] = canonical(stopped.y);
      moved_.z[i] = canonical(stopped.z);
      v.x[i] = canonical(v.x[i] + kick.x);
      v.y[i] = canonical(v.y[i] + kick.y);
      v.z[i] = canonical(v.z[i] + kick.z);
    }
  });
  std::swap(after.positions, moved_);
}

template <class Real>
std::vector<std::pair<std::uint32_t, std::uint32_t>> SelfCollision<Real>::candidatePairs(
    const Components<Real>& positions) {
  Components<Real> velocities;
  velocities.resize(positions.x.size());
  buildHash({positions, velocities});
  findCandidates();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Block& block : blocks_) {
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      for (std::uint32_t slot = 0; slot < candidateCounts_[i]; ++slot)
        pairs.emplace_back(i, candidateAt(slot, i) & INDEX_MASK);
    }
  }
  for (const auto& [i, candidate] : overflow_) pairs.emplace_back(i, candidate & INDEX_MASK);
  return pairs;
}

template class SelfCollision<float>;
template class SelfCollision<double>;

}  // namespace clothsim::cpu
