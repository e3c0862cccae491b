#include "solver/cpu/self_collision.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>

#include "cloth/cuts.h"
#include "core/exact_math.h"
#include "core/thread_team.h"
#include "core/vec.h"
#include "solver/cpu/vector_clones.h"
#include "solver/step_params.h"

namespace clothsim::cpu {
namespace {

constexpr std::uint8_t WALK = MOST_CANDIDATES + 1;
constexpr std::uint32_t EXCLUDED = ~0u;
constexpr std::uint32_t TILES_AT_ONCE = 8;

// --- The hash: x-neighbours share three buckets in a row.

struct Cell {
  std::int32_t x, y, z;
};

template <class Real>
INLINE std::int32_t cellCoordinate(Real x, Real inverseCell) {
  constexpr Real largest = 131072;  // 2^17
  Real c = x * inverseCell;
  c = c < largest ? c : largest;  // NaN, too
  c = c < -largest ? -largest : c;
  const auto towardsZero = static_cast<std::int32_t>(c);
  return towardsZero - (c < static_cast<Real>(towardsZero) ? 1 : 0);  // floor
}

template <class Real>
INLINE Cell cellAt(const Components<Real>& p, std::size_t i, Real inverseCell) {
  return {cellCoordinate(p.x[i], inverseCell), cellCoordinate(p.y[i], inverseCell),
          cellCoordinate(p.z[i], inverseCell)};
}

INLINE std::uint32_t bucketOf(Cell cell, std::uint32_t mask) {
  std::uint32_t h = static_cast<std::uint32_t>(cell.y) * 0x9e3779b1u;
  h = (h ^ (h >> 15)) + static_cast<std::uint32_t>(cell.z) * 0x85ebca77u;
  h = (h ^ (h >> 13)) * 0xc2b2ae3du;
  return ((h ^ (h >> 16)) + static_cast<std::uint32_t>(cell.x)) & mask;
}

template <class Real>
View<Real> viewOf(const SelfParams<Real>& params, const CpuState<Real>& before, const CpuState<Real>& after,
                  const std::vector<Real>& inverseMasses, const std::vector<Real>& distances,
                  const Block& block) {
  const Components<Real>&p0 = before.positions, &p = after.positions;
  return {params,
          p0.x.data(),
          p0.y.data(),
          p0.z.data(),
          p.x.data(),
          p.y.data(),
          p.z.data(),
          inverseMasses.data(),
          distances.data() + static_cast<std::size_t>(block.piece) * NEAREST_CODES};
}

// All entries that may lie in the 27 cells about a cell: `visit(entry, y, z)` is to take those whose cell has
// this y and z, since a bucket may hold several cells.
template <class Real, class Visit>
void visitCells(const SelfParams<Real>& params, const std::vector<std::uint32_t>& bucketStarts, Cell cell,
                Visit visit) {
  const auto visitBuckets = [&](std::uint32_t first, std::uint32_t last, std::int32_t y, std::int32_t z) {
    for (std::uint32_t entry = bucketStarts[first]; entry < bucketStarts[last + 1]; ++entry)
      visit(entry, y, z);
  };
  for (std::int32_t z = cell.z - 1; z <= cell.z + 1; ++z) {
    for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
      const std::uint32_t left = bucketOf({cell.x - 1, y, z}, params.bucketMask);
      if (left + 2 <= params.bucketMask) {
        visitBuckets(left, left + 2, y, z);
      } else {
        for (std::uint32_t k = 0; k < 3; ++k)
          visitBuckets((left + k) & params.bucketMask, (left + k) & params.bucketMask, y, z);
      }
    }
  }
}

template <class Real>
bool hasCell(const SelfParams<Real>& params, const Components<Real>& sortedPositions, std::uint32_t entry,
             std::int32_t y, std::int32_t z) {
  return cellCoordinate(sortedPositions.y[entry], params.inverseCell) == y &&
         cellCoordinate(sortedPositions.z[entry], params.inverseCell) == z;
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
  sortedPositions_.resize(count);
  moved_.resize(count);
  bucketStarts_.resize(static_cast<std::size_t>(params_.bucketMask) + 2);
  sorted_.resize(count);
  bucketOf_.resize(count);
  ranks_.resize(count);
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
void SelfCollision<Real>::buildHash(const CpuState<Real>& state) {
  ++counts_.hashBuilds;
  isStale_ = false;
  hashedPositions_ = state.positions;
  hashedMotion_ = RigidMotion(state.positions, state.velocities);
  stepsSinceHash_ = 0;
}

template <class Real>
void SelfCollision<Real>::fillBuckets() {
  const Components<Real>& positions = hashedPositions_;
  std::fill(bucketStarts_.begin(), bucketStarts_.end(), 0);
  forEachBlock([&](const Block& block) {  // histogram: the ranks are in no particular order
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      bucketOf_[i] = bucketOf(cellAt(positions, i, params_.inverseCell), params_.bucketMask);
      ranks_[i] = std::atomic_ref(bucketStarts_[bucketOf_[i]]).fetch_add(1, std::memory_order_relaxed);
    }
  });
  std::uint32_t start = 0;
  for (std::uint32_t& bucket : bucketStarts_) start += std::exchange(bucket, start);
  forEachBlock([&](const Block& block) {
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      const std::uint32_t entry = bucketStarts_[bucketOf_[i]] + ranks_[i];
      sorted_[entry] = i;
      sortedPositions_.x[entry] = positions.x[i];
      sortedPositions_.y[entry] = positions.y[i];
      sortedPositions_.z[entry] = positions.z[i];
    }
  });
}

template <class Real>
void SelfCollision<Real>::findCandidates() {
  tiles_.setPositions(hashedPositions_);
  // Neighbours that a cut parts are candidates.
  const Real reach = static_cast<Real>(params_.firstCode) - 1,
             neighbors = cutMasks_.empty() ? 2 * reach * reach : Real(-1);
  std::atomic<bool> lacksMemory = false;  // threads must not throw
  ThreadTeam::shared().forEach(0, tiles_.tiles(), TILES_AT_ONCE, [&](std::uint32_t tile) {
    try {
      thread_local std::vector<NearTile> found;
      found.clear();
      tiles_.find(tile, params_.searchSquared, neighbors, found);
      setCandidates(tile, found);
    } catch (const std::bad_alloc&) {
      lacksMemory = true;
    }
  });
  if (lacksMemory) throw std::bad_alloc();
  std::atomic<bool> anyWalks = false;
  forEachBlock([&](Block& block) {
    const auto kept = [&](std::uint32_t i) {
      if (candidateCounts_[i] == WALK) anyWalks = true;
      return candidateCounts_[i] == WALK ? 0u : candidateCounts_[i];
    };
    block.slots = 0;
    for (std::uint32_t i = block.begin; i < block.end; ++i) block.slots = std::max(block.slots, kept(i));
    for (std::uint32_t i = block.begin; i < block.end; ++i)
      for (std::uint32_t slot = kept(i); slot < block.slots; ++slot) candidateAt(slot, i) = i;
  });
  if (anyWalks) fillBuckets();
}

template <class Real>
void SelfCollision<Real>::setCandidates(std::uint32_t tile, std::span<const NearTile> found) {
  const std::span<const std::uint32_t> particles = tiles_.particlesOf(tile);
  for (const std::uint32_t i : particles) candidateCounts_[i] = 0;
  for (const NearTile& other : found)
    for (std::uint32_t near = other.near; near != 0; near &= near - 1) {
      const std::uint32_t i = particles[static_cast<std::size_t>(std::countr_zero(near))];
      if (i == other.particle || candidateCounts_[i] == WALK) continue;
      const std::uint32_t candidate = encode(tiles_.pieceOf(tile), i, other.particle);
      if (candidate == EXCLUDED) continue;
      if (candidateCounts_[i] < MOST_CANDIDATES) candidateAt(candidateCounts_[i], i) = candidate;
      ++candidateCounts_[i];  // one too many: WALK
    }
}

template <class Real>
template <class Visit>
void SelfCollision<Real>::walk(const Block& block, std::uint32_t i, Visit visit) const {
  visitCells(params_, bucketStarts_, cellAt(hashedPositions_, i, params_.inverseCell),
             [&](std::uint32_t entry, std::int32_t y, std::int32_t z) {
               if (sorted_[entry] == i || !hasCell(params_, sortedPositions_, entry, y, z)) return;
               const std::uint32_t candidate = encode(block.piece, i, sorted_[entry]);
               if (candidate != EXCLUDED) visit(candidate);
             });
}

template <class Real>
void SelfCollision<Real>::resolveContacts(const CpuState<Real>& before, CpuState<Real>& after,
                                          const std::vector<Real>& inverseMasses) {
  forEachBlock([&](const Block& block) {
    const View<Real> view = viewOf(params_, before, after, inverseMasses, distances_, block);
    Sums<Real> sums;
    addContacts(isRobust(), usesNearCodes(), view, candidates_.data(), block, sums);
    for (std::uint32_t i = block.begin; i < block.end; ++i)
      if (candidateCounts_[i] == WALK)
        walk(block, i, [&](std::uint32_t candidate) {
          isRobust() ? addPair<true, true>(view, i, candidate, sums, i - block.begin)
                     : addPair<false, true>(view, i, candidate, sums, i - block.begin);
        });
    if (std::any_of(sums.count.begin(), sums.count.end(), [](std::uint32_t count) { return count != 0; }))
      moveByContacts(isRobust(), view, block, sums, moved_, after.velocities);
    else
      copyBlock(after.positions, moved_, block);
  });
  std::swap(after.positions, moved_);
}

template <class Real>
void SelfCollision<Real>::checkHash(const CpuState<Real>& before, const CpuState<Real>& after) {
  constexpr std::uint32_t particlesAtOnce = 512;
  std::atomic<bool> stale = isStale_, fast = false;
  ThreadTeam::shared().forEachRange(
      0, params_.particles, particlesAtOnce, [&](std::uint32_t begin, std::uint32_t end) {
        const Range particles{static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end)};
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
  std::atomic<bool> any = false;
  forEachBlock([&](const Block& block) {
    if (any) return;
    const View<Real> view = viewOf(params_, before, after, inverseMasses, distances_, block);
    bool found = anyTooNear(usesNearCodes(), view, candidates_.data(), block);
    for (std::uint32_t i = block.begin; i < block.end && !found; ++i)
      if (candidateCounts_[i] == WALK)
        walk(block, i, [&](std::uint32_t candidate) { found = found || tooNear<true>(view, i, candidate); });
    if (found) any = true;
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
    const View<Real> view = viewOf(params_, before, after, inverseMasses, distances_, block);
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      const Vec3<Real> x = load(view.x, view.y, view.z, i), start = load(view.x0, view.y0, view.z0, i);
      moved_.x[i] = x.x;
      moved_.y[i] = x.y;
      moved_.z[i] = x.z;
      Real kept = 1;
      const auto look = [&](std::uint32_t candidate) { kept = keptMotion<true>(view, i, candidate, kept); };
      for (std::uint32_t slot = 0; slot < block.slots; ++slot) look(candidateAt(slot, i));
      if (candidateCounts_[i] == WALK) walk(block, i, look);
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
      const auto add = [&](std::uint32_t candidate) { pairs.emplace_back(i, candidate & INDEX_MASK); };
      if (candidateCounts_[i] == WALK)
        walk(block, i, add);
      else
        for (std::uint32_t slot = 0; slot < candidateCounts_[i]; ++slot) add(candidateAt(slot, i));
    }
  }
  return pairs;
}

template class SelfCollision<float>;
template class SelfCollision<double>;

}  // namespace clothsim::cpu
