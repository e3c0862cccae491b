#include "solver/cpu/contact_blocks.h"

#include <algorithm>
#include <type_traits>

#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

template <bool nearCodes, class Real>
INLINE bool slotTouches(const View<Real>& view, const std::uint32_t* row, const Block& block) {
  std::uint32_t any = 0;
#pragma omp simd reduction(| : any)
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    const std::size_t j = row[i] & INDEX_MASK;
    const Real distance = pairDistance<nearCodes>(view, row[i]);
    const Vec3<Real> d = load(view.x, view.y, view.z, i) - load(view.x, view.y, view.z, j);
    any |= ((dot(d, d) < distance * distance) & (i != j)) ? 1u : 0u;
  }
  return any != 0;
}

// Most candidates are no contacts now: a slot is looked at briefly first.
template <bool robust, bool nearCodes, class Real>
INLINE void addLanes(const View<Real>& view, const std::uint32_t* candidates, const Block& block,
                     Sums<Real>& sums) {
  for (std::uint32_t slot = 0; slot < block.slots; ++slot) {
    const std::uint32_t* row = candidates + static_cast<std::size_t>(slot) * view.params.particles;
    if (!slotTouches<nearCodes>(view, row, block)) continue;
#pragma omp simd
    for (std::uint32_t i = block.begin; i < block.end; ++i)
      addPair<robust, nearCodes>(view, i, row[i], sums, i - block.begin);
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

INLINE Range rangeOf(const Block& block) {
  return {static_cast<std::ptrdiff_t>(block.begin), static_cast<std::ptrdiff_t>(block.end)};
}

// Hardly any candidates are that near: all slots are looked at briefly first, without where they came from.
template <bool nearCodes, class Real>
INLINE bool anyLaneTooNear(const View<Real>& view, const std::uint32_t* candidates, const Block& block) {
  std::uint32_t near[BLOCK]{};
  const Real *x = view.x, *y = view.y, *z = view.z, clampFactor = view.params.clampFactor;
  for (std::uint32_t slot = 0; slot < block.slots; ++slot) {
    const std::uint32_t* row = candidates + static_cast<std::size_t>(slot) * view.params.particles;
    forEachSixteen(
        rangeOf(block), [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
          for (std::ptrdiff_t i = begin; i < end; ++i) {
            const auto j = static_cast<std::ptrdiff_t>(row[i] & INDEX_MASK);
            const Real least = clampFactor * pairDistance<nearCodes>(view, row[i]);
            const Vec3<Real> d = load(x, y, z, i) - load(x, y, z, j);
            near[i - begin] |= ((dot(d, d) < least * least) & (i != j)) ? 1u : 0u;
          }
        });
  }
  if (largestOf(near) == 0) return false;
  std::uint32_t any = 0;
  for (std::uint32_t slot = 0; slot < block.slots; ++slot) {
    const std::uint32_t* row = candidates + static_cast<std::size_t>(slot) * view.params.particles;
#pragma omp simd reduction(| : any)
    for (std::uint32_t i = block.begin; i < block.end; ++i)
      any |= tooNear<nearCodes>(view, i, row[i]) ? 1u : 0u;
  }
  return any != 0;
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
VECTOR_CLONES(void, addRobust,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block,
               Sums<float>& sums),
              (view, candidates, block, sums), addLanes<true, false>(view, candidates, block, sums))
VECTOR_CLONES(bool, anyFloatLaneTooNear,
              (const View<float>& view, const std::uint32_t* candidates, const Block& block),
              (view, candidates, block), anyLaneTooNear<false>(view, candidates, block))
VECTOR_CLONES(bool, anyFloatLaneMoved,
              (const Arrays<const float>& now, const Arrays<const float>& then, Range particles,
               float largestSquared),
              (now, then, particles, largestSquared), anyLaneMoved(now, then, particles, largestSquared))

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
  if (robust && nearCodes) return addLanes<true, true>(view, candidates, block, sums);
  if (nearCodes) return addLanes<false, true>(view, candidates, block, sums);
  if constexpr (std::is_same_v<Real, float>)
    return robust ? addRobust(view, candidates, block, sums) : addAveraged(view, candidates, block, sums);
  else
    return robust ? addLanes<true, false>(view, candidates, block, sums)
                  : addLanes<false, false>(view, candidates, block, sums);
}

template <class Real>
bool anyTooNear(bool nearCodes, const View<Real>& view, const std::uint32_t* candidates, const Block& block) {
  if (nearCodes) return anyLaneTooNear<true>(view, candidates, block);
  if constexpr (std::is_same_v<Real, float>) return anyFloatLaneTooNear(view, candidates, block);
  return anyLaneTooNear<false>(view, candidates, block);
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

}  // namespace clothsim::cpu
