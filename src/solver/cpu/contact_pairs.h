// What two particles do to each other under self-collision, on the CPU: the twin of
// shaders/sim/self/resolve_contacts.comp, check_motion.comp and clamp_motion.comp. What and why:
// solver/self_collision.h.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/exact_math.h"
#include "core/vec.h"
#include "core/vector_clones.h"
#include "solver/cpu/rows.h"
#include "solver/self_collision.h"

namespace clothsim::cpu {

inline constexpr std::uint32_t BLOCK = 16;  // particles; floats in the widest vector register
inline constexpr std::uint32_t INDEX_MASK = (1u << CANDIDATE_BITS) - 1;

template <class Real>
using Quanta = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, std::uint64_t>;

// The nearest whole number, for |x| < 2^22 (2^51): adding 1.5 * 2^23 leaves it in the low bits.
INLINE std::uint32_t toFixedPoint(float x) {
  constexpr float magic = 12582912.0f;
  return std::bit_cast<std::uint32_t>(x + magic) - std::bit_cast<std::uint32_t>(magic);
}
INLINE std::uint64_t toFixedPoint(double x) {
  constexpr double magic = 6755399441055744.0;
  return std::bit_cast<std::uint64_t>(x + magic) - std::bit_cast<std::uint64_t>(magic);
}
// In two halves, each of which converts exactly.
INLINE float fromFixedPoint(std::uint32_t sum) {
  const auto number = static_cast<std::int32_t>(sum);
  return static_cast<float>(number >> 12) * 4096.0f + static_cast<float>(number & 4095);
}
INLINE double fromFixedPoint(std::uint64_t sum) {
  return static_cast<double>(static_cast<std::int64_t>(sum));
}

template <class Real>
struct Sums {
  alignas(64) std::array<Quanta<Real>, BLOCK> x{}, y{}, z{};
  alignas(64) std::array<std::uint32_t, BLOCK> count{};
};

// What the passes read of the particles.
template <class Real>
struct View {
  const SelfParams<Real>& params;
  const Real *x0, *y0, *z0;  // at the start of the step
  const Real *x, *y, *z;     // now
  const Real* fours;         // the same, four numbers a particle
  const Real* inverseMasses;
  const Real* distances;  // of the block's grid, by code
};

template <bool nearCodes, class Real>
INLINE Real pairDistance(const View<Real>& view, std::uint32_t candidate) {
  return nearCodes ? view.distances[candidate >> CANDIDATE_BITS] : view.params.distance;
}

// What a contact asks of a particle; of one that is none, 0.
template <class Real>
struct Push {
  Quanta<Real> x, y, z;
  std::uint32_t count;
};

// Particles nearer than their distance go apart, by half of what is missing each (all of it for CS184's rule,
// and next to a pinned particle); friction takes back what they slid past each other in this step, up to its
// coefficient times that.
template <bool robust, bool nearCodes, class Real>
INLINE Push<Real> pushOf(const View<Real>& view, std::size_t i, std::uint32_t candidate) {
  const std::size_t j = candidate & INDEX_MASK;
  const Real distance = pairDistance<nearCodes>(view, candidate);
  const Real distanceSquared = distance * distance;
  const Vec3<Real> d = load(view.x, view.y, view.z, i) - load(view.x, view.y, view.z, j);
  const Real lengthSquared = dot(d, d);
  const bool touches = (lengthSquared < distanceSquared) & (i != j);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real depth = distance - lengthSquared * inverseLength;
  Vec3<Real> normal = inverseLength * d;
  const Real anyWay = i < j ? Real(-1) : Real(1);  // for two particles at one place
  normal.y = lengthSquared == Real(0) ? anyWay : normal.y;
  Vec3<Real> move = depth * normal;
  if constexpr (robust) {
    const Vec3<Real> motion = load(view.x, view.y, view.z, i) - load(view.x0, view.y0, view.z0, i);
    const Vec3<Real> otherMotion = load(view.x, view.y, view.z, j) - load(view.x0, view.y0, view.z0, j);
    const Vec3<Real> relative = motion - otherMotion;
    const Real along = dot(relative, normal);
    const Vec3<Real> slip = relative - along * normal;
    const Real slipSquared = dot(slip, slip);
    const Real reach = view.params.friction * depth;
    const Real reachSquared = reach * reach;
    const Real part = reach * inverseSquareRoot(slipSquared);
    const Real share = view.inverseMasses[j] == Real(0) ? Real(1) : Real(0.5);
    move = share * (move - (reachSquared < slipSquared ? part : Real(1)) * slip);
  }
  const Real units = view.params.unitsPerMeter;
  return {touches ? toFixedPoint(units * move.x) : 0, touches ? toFixedPoint(units * move.y) : 0,
          touches ? toFixedPoint(units * move.z) : 0, touches ? 1u : 0u};
}
template <class Real>
INLINE void add(Sums<Real>& sums, std::size_t lane, const Push<Real>& push) {
  sums.x[lane] += push.x;
  sums.y[lane] += push.y;
  sums.z[lane] += push.z;
  sums.count[lane] += push.count;
}

// Whether a free particle has come nearer to a non-adjacent particle than D in this step.
template <bool nearCodes, class Real>
INLINE bool tooNear(const View<Real>& view, std::size_t i, std::uint32_t candidate) {
  const std::size_t j = candidate & INDEX_MASK;
  const Real least = view.params.clampFactor * pairDistance<nearCodes>(view, candidate);
  const Real leastSquared = least * least;
  const Vec3<Real> d = load(view.x, view.y, view.z, i) - load(view.x, view.y, view.z, j);
  const Vec3<Real> d0 = load(view.x0, view.y0, view.z0, i) - load(view.x0, view.y0, view.z0, j);
  const Real lengthSquared = dot(d, d), lengthSquaredBefore = dot(d0, d0);
  return (lengthSquared < leastSquared) & (lengthSquared < lengthSquaredBefore) & (i != j) &
         (view.inverseMasses[i] > Real(0));
}

// How much of its motion a particle may keep, as far as this candidate goes: half of what lies between the
// two and D along the line that joined them; next to a pinned particle what that leaves.
template <bool nearCodes, class Real>
INLINE Real keptMotion(const View<Real>& view, std::size_t i, std::uint32_t candidate, Real kept) {
  const std::size_t j = candidate & INDEX_MASK;
  const Real least = view.params.clampFactor * pairDistance<nearCodes>(view, candidate);
  const Vec3<Real> start = load(view.x0, view.y0, view.z0, i),
                   otherStart = load(view.x0, view.y0, view.z0, j);
  const Vec3<Real> d = start - otherStart;
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Vec3<Real> normal = inverseLength * d;
  const Real gap = lengthSquared * inverseLength - least;
  const Real slack = gap < Real(0) ? Real(0) : gap;
  const Vec3<Real> motion = load(view.x, view.y, view.z, i) - start;
  const Vec3<Real> otherMotion = load(view.x, view.y, view.z, j) - otherStart;
  const Real away = dot(motion, normal);
  const Real closing = -away;
  const Real otherClosing = dot(otherMotion, normal);
  const Real taken = otherClosing < Real(0) ? Real(0) : otherClosing;
  const Real left = slack < taken ? Real(0) : slack - taken;
  const Real allowed = view.inverseMasses[j] == Real(0) ? left : Real(0.5) * slack;
  const Real part = allowed * reciprocal(closing);
  const bool binds = (allowed < closing) & (i != j);
  const Real now = binds ? part : Real(1);
  return now < kept ? now : kept;
}

}  // namespace clothsim::cpu
