#include "solver/cpu/contact_blocks.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/vectors.h"

namespace clothsim::cpu {
namespace {

INLINE Range rangeOf(const Block& block) {
  return {static_cast<std::ptrdiff_t>(block.begin), static_cast<std::ptrdiff_t>(block.end)};
}

// Of each particle of a block the slots with candidates that are nearer than `factor` times their distance: a
// bit each. The places of all slots' candidates are gathered first: a processor waits when it reads sixteen
// numbers at once that it has just written four by four.
template <bool nearCodes, class Real>
INLINE void findNear(const View<Real>& view, const std::uint32_t* candidates, const Block& block, Real factor,
                     std::uint32_t (&near)[BLOCK]) {
  const Real *x = view.x, *y = view.y, *z = view.z;
  Real others[MOST_CANDIDATES][3][BLOCK];
  const auto rowOf = [&](std::uint32_t slot) __attribute__((always_inline)) {
    return candidates + static_cast<std::size_t>(slot) * view.params.particles;
  };
  forEachSixteen(
      rangeOf(block), [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
        for (std::uint32_t slot = 0; slot < block.slots; ++slot) {
          const std::uint32_t* row = rowOf(slot) + begin;
          auto& [otherX, otherY, otherZ] = others[slot];
          gatherFours(
              view.fours, end - begin,
              [&](std::ptrdiff_t lane)
                  __attribute__((always_inline)) { return std::size_t{row[lane] & INDEX_MASK}; },
              otherX, otherY, otherZ);
        }
        for (std::uint32_t slot = 0; slot < block.slots; ++slot) {
          const std::uint32_t* row = rowOf(slot) + begin;
          const auto& [otherX, otherY, otherZ] = others[slot];
#pragma GCC ivdep
          for (std::ptrdiff_t lane = 0; lane < end - begin; ++lane) {
            const Real least = factor * pairDistance<nearCodes>(view, row[lane]);
            const Vec3<Real> d = load(x, y, z, begin + lane) - load(otherX, otherY, otherZ, lane);
            const auto itself = static_cast<std::uint32_t>(begin + lane);
            const bool isNear = (dot(d, d) < least * least) & (itself != (row[lane] & INDEX_MASK));
            near[lane] |= (isNear ? 1u : 0u) << slot;
          }
        }
      });
}
// visit(particle, candidate) for those that findNear() found.
template <class Real, class Visit>
INLINE void forEachFound(const View<Real>& view, const std::uint32_t* candidates, const Block& block,
                         const std::uint32_t (&near)[BLOCK], Visit visit) {
  for (std::uint32_t i = block.begin; i < block.end; ++i)
    for (std::uint32_t slots = near[i - block.begin]; slots != 0; slots &= slots - 1)
      visit(i, candidates[static_cast<std::size_t>(std::countr_zero(slots)) * view.params.particles + i]);
}

// Most candidates are no contacts now: those that are, of all slots, are worked out sixteen at a time.
template <bool robust, bool nearCodes, class Real>
INLINE void addLanes(const View<Real>& view, const std::uint32_t* candidates, const Block& block,
                     Sums<Real>& sums) {
  std::uint32_t near[BLOCK]{};
  findNear<nearCodes>(view, candidates, block, Real(1), near);
  if (largestOf(near) == 0) return;
  std::uint32_t particles[BLOCK * MOST_CANDIDATES], others[BLOCK * MOST_CANDIDATES];
  std::uint32_t count = 0;
  forEachFound(view, candidates, block, near, [&](std::uint32_t i, std::uint32_t candidate) {
    particles[count] = i;
    others[count++] = candidate;
  });
  while (count % BLOCK != 0) particles[count] = others[count] = block.begin, ++count;  // touch nothing
  for (std::uint32_t first = 0; first < count; first += BLOCK) {
    Sums<Real> pushes;
#pragma GCC ivdep
    for (std::uint32_t k = 0; k < BLOCK; ++k) {
      const Push<Real> push = pushOf<robust, nearCodes>(view, particles[first + k], others[first + k]);
      pushes.x[k] = push.x, pushes.y[k] = push.y, pushes.z[k] = push.z, pushes.count[k] = push.count;
    }
    for (std::uint32_t k = 0; k < BLOCK; ++k)
      add(sums, particles[first + k] - block.begin,
          Push<Real>{pushes.x[k], pushes.y[k], pushes.z[k], pushes.count[k]});
  }
}

// Every free particle goes by the mean over its contacts.
template <bool robust, class Real>
INLINE void moveLanes(const View<Real>& view, const Block& block, const Sums<Real>& sums, Real* const* newX,
                      Real* const* velocity) {
  const SelfParams<Real>& params = view.params;
  const Real largest = params.largestMove, largestSquared = largest * largest,
             inverseTimeStep = params.inverseTimeStep;
  Real *newXx = newX[0], *newXy = newX[1], *newXz = newX[2];
  Real *vx = velocity[0], *vy = velocity[1], *vz = velocity[2];
#pragma omp simd
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    const std::uint32_t lane = i - block.begin;
    const Vec3<Real> x = load(view.x, view.y, view.z, i), v = load(vx, vy, vz, i);
    const Real factor =
        params.moveFactor * reciprocal(static_cast<Real>(static_cast<std::int32_t>(sums.count[lane])));
    Vec3<Real> move = factor * Vec3<Real>{fromFixedPoint(sums.x[lane]), fromFixedPoint(sums.y[lane]),
                                          fromFixedPoint(sums.z[lane])};
    if constexpr (robust) {
      const Real lengthSquared = dot(move, move);
      const Vec3<Real> shorter = (largest * inverseSquareRoot(lengthSquared)) * move;
      const bool tooFar = largestSquared < lengthSquared;
      move = {tooFar ? shorter.x : move.x, tooFar ? shorter.y : move.y, tooFar ? shorter.z : move.z};
    }
    const Vec3<Real> moved = x + move, kicked = v + inverseTimeStep * move;
    const bool moves = (sums.count[lane] != 0) & (view.inverseMasses[i] != Real(0));
    newXx[i] = moves ? canonical(moved.x) : x.x;
    newXy[i] = moves ? canonical(moved.y) : x.y;
    newXz[i] = moves ? canonical(moved.z) : x.z;
    vx[i] = moves ? canonical(kicked.x) : v.x;
    vy[i] = moves ? canonical(kicked.y) : v.y;
    vz[i] = moves ? canonical(kicked.z) : v.z;
  }
}

// Hardly any candidates are that near: where they came from is looked at afterwards.
template <bool nearCodes, class Real>
INLINE bool anyLaneTooNear(const View<Real>& view, const std::uint32_t* candidates, const Block& block) {
  std::uint32_t near[BLOCK]{};
  findNear<nearCodes>(view, candidates, block, view.params.clampFactor, near);
  if (largestOf(near) == 0) return false;
  bool any = false;
  forEachFound(view, candidates, block, near, [&](std::uint32_t i, std::uint32_t candidate) {
    any |= tooNear<nearCodes>(view, i, candidate);
  });
  return any;
}

template <class Real>
INLINE void putFoursOf(const Arrays<const Real>& positions, Range particles, Real* fours) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i)
    putFour(fours, static_cast<std::size_t>(i), at(positions, i));
}

template <class Real>
INLINE bool anyLaneMoved(const Arrays<const Real>& now, const Arrays<const Real>& then, Range particles,
                         Real largestSquared) {
  std::uint32_t moved[BLOCK]{};
  forEachSixteen(
      particles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const Vec3<Real> d = at(now, i) - at(then, i);
          moved[i - begin] |= dot(d, d) < largestSquared ? 0u : 1u;  // NaN has moved, too
        }
      });
  return largestOf(moved) != 0;
}

VECTOR_CLONES(void, addAveraged,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block,
               Sums<float>& sums),
              (view, candidates, block, sums), addLanes<false, false>(view, candidates, block, sums))
VECTOR_CLONES(void, addAveragedByCode,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block,
               Sums<float>& sums),
              (view, candidates, block, sums), addLanes<false, true>(view, candidates, block, sums))
VECTOR_CLONES(void, addRobust,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block,
               Sums<float>& sums),
              (view, candidates, block, sums), addLanes<true, false>(view, candidates, block, sums))
VECTOR_CLONES(void, addRobustByCode,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block,
               Sums<float>& sums),
              (view, candidates, block, sums), addLanes<true, true>(view, candidates, block, sums))
VECTOR_CLONES(bool, anyFloatLaneTooNear,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block),
              (view, candidates, block), anyLaneTooNear<false>(view, candidates, block))
VECTOR_CLONES(bool, anyFloatLaneTooNearByCode,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block),
              (view, candidates, block), anyLaneTooNear<true>(view, candidates, block))
VECTOR_CLONES(bool, anyFloatLaneMoved,
              (const Arrays<const float>& now, const Arrays<const float>& then, Range particles,
               float largestSquared),
              (now, then, particles, largestSquared), anyLaneMoved(now, then, particles, largestSquared))

VECTOR_CLONES(void, putFloatFours, (const Arrays<const float>& positions, Range particles, float* fours),
              (positions, particles, fours), putFoursOf(positions, particles, fours))
VECTOR_CLONES(void, moveAveraged,
              (const View<float>& view, const Block& block, const Sums<float>& sums, float* const* newX,
               float* const* velocity),
              (view, block, sums, newX, velocity), moveLanes<false>(view, block, sums, newX, velocity))
VECTOR_CLONES(void, moveRobust,
              (const View<float>& view, const Block& block, const Sums<float>& sums, float* const* newX,
               float* const* velocity),
              (view, block, sums, newX, velocity), moveLanes<true>(view, block, sums, newX, velocity))

}  // namespace

template <class Real>
void moveByContacts(bool robust, const View<Real>& view, const Block& block, const Sums<Real>& sums,
                    Components<Real>& newPositions, Components<Real>& velocities) {
  Real* const newX[] = {newPositions.x.data(), newPositions.y.data(), newPositions.z.data()};
  Real* const velocity[] = {velocities.x.data(), velocities.y.data(), velocities.z.data()};
  if constexpr (std::is_same_v<Real, float>)
    robust ? moveRobust(view, block, sums, newX, velocity) : moveAveraged(view, block, sums, newX, velocity);
  else
    robust ? moveLanes<true>(view, block, sums, newX, velocity)
           : moveLanes<false>(view, block, sums, newX, velocity);
}

template <class Real>
void addContacts(bool robust, bool nearCodes, const View<Real>& view, const std::uint32_t* candidates,
                 const Block& block, Sums<Real>& sums) {
  if constexpr (std::is_same_v<Real, float>) {
    const auto add =
        nearCodes ? (robust ? addRobustByCode : addAveragedByCode) : (robust ? addRobust : addAveraged);
    return add(view, candidates, block, sums);
  } else {
    const auto add = nearCodes ? (robust ? addLanes<true, true, Real> : addLanes<false, true, Real>)
                               : (robust ? addLanes<true, false, Real> : addLanes<false, false, Real>);
    return add(view, candidates, block, sums);
  }
}

template <class Real>
bool anyTooNear(bool nearCodes, const View<Real>& view, const std::uint32_t* candidates, const Block& block) {
  if constexpr (std::is_same_v<Real, float>)
    return nearCodes ? anyFloatLaneTooNearByCode(view, candidates, block)
                     : anyFloatLaneTooNear(view, candidates, block);
  return nearCodes ? anyLaneTooNear<true>(view, candidates, block)
                   : anyLaneTooNear<false>(view, candidates, block);
}

template <class Real>
void putFours(const Components<Real>& positions, Range particles, Real* fours) {
  if constexpr (std::is_same_v<Real, float>)
    putFloatFours(arraysOf(positions), particles, fours);
  else
    putFoursOf(arraysOf(positions), particles, fours);
}

template <class Real>
bool anyMovedFarther(const Components<Real>& now, const Components<Real>& then, Range particles,
                     Real largestSquared) {
  if constexpr (std::is_same_v<Real, float>)
    return anyFloatLaneMoved(arraysOf(now), arraysOf(then), particles, largestSquared);
  else
    return anyLaneMoved(arraysOf(now), arraysOf(then), particles, largestSquared);
}

namespace {

template <class Real>
INLINE bool anyLaneLeft(const Components<Real>& now, const Components<Real>& then,
                        const RigidMap<Real>& motion, const Block& block, Real largestSquared) {
  const Arrays<const Real> here = arraysOf(now), before = arraysOf(then);
  const Vec3<Real> right = motion.rows[0], up = motion.rows[1], back = motion.rows[2];
  const Vec3<Real> center = motion.center, movedCenter = motion.movedCenter;
  std::uint32_t any = 0;
  for (auto i = static_cast<std::ptrdiff_t>(block.begin); i < static_cast<std::ptrdiff_t>(block.end); ++i) {
    const Vec3<Real> arm = at(before, i) - center, turned{dot(right, arm), dot(up, arm), dot(back, arm)};
    const Vec3<Real> left = at(here, i) - (movedCenter + turned);
    any |= dot(left, left) <= largestSquared ? 0U : 1U;  // no number has left it, too
  }
  return any != 0;
}

}  // namespace

VECTOR_CLONES(bool, anyLeftMotion,
              (const Components<float>& now, const Components<float>& then, const RigidMap<float>& motion,
               const Block& block, float largestSquared),
              (now, then, motion, block, largestSquared),
              anyLaneLeft(now, then, motion, block, largestSquared))
bool anyLeftMotion(const Components<double>& now, const Components<double>& then,
                   const RigidMap<double>& motion, const Block& block, double largestSquared) {
  return anyLaneLeft(now, then, motion, block, largestSquared);
}

template <class Real>
void copyBlock(const Components<Real>& from, Components<Real>& to, const Block& block) {
  std::copy(&from.x[0] + block.begin, &from.x[0] + block.end, &to.x[0] + block.begin);
  std::copy(&from.y[0] + block.begin, &from.y[0] + block.end, &to.y[0] + block.begin);
  std::copy(&from.z[0] + block.begin, &from.z[0] + block.end, &to.z[0] + block.begin);
}

#define INSTANTIATE(Real)                                                                                    \
  template void addContacts(bool, bool, const View<Real>&, const std::uint32_t*, const Block&, Sums<Real>&); \
  template void moveByContacts(bool, const View<Real>&, const Block&, const Sums<Real>&, Components<Real>&,  \
                               Components<Real>&);                                                           \
  template bool anyTooNear(bool, const View<Real>&, const std::uint32_t*, const Block&);                     \
  template bool anyMovedFarther(const Components<Real>&, const Components<Real>&, Range, Real);              \
  template void copyBlock(const Components<Real>&, Components<Real>&, const Block&);
INSTANTIATE(float)
INSTANTIATE(double)
template void putFours(const Components<float>&, Range, float*);
template void putFours(const Components<double>&, Range, double*);

}  // namespace clothsim::cpu
