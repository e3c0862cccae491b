// The springs of a row of a grid: each is computed once, by its owner.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/own_springs.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/spring_rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {

// The forces of the springs that the particles of a stretch own, into `row`. Returns the largest bits of l^2.
template <bool hasCuts, class Real, class RestLengths>
INLINE auto computeSprings(const PassArguments<Real>& arguments, Range particles, SpringPlace place,
                           Real stiffness, RestLengths rest, const Arrays<Real>& row, std::ptrdiff_t start) {
  const std::ptrdiff_t other = place.other;
  const std::uint32_t* cutMasks = arguments.cutMasks;
  const Real *x = arguments.before.positions.x.data(), *y = arguments.before.positions.y.data(),
             *z = arguments.before.positions.z.data();
  Real *fx = row.x - start, *fy = row.y - start, *fz = row.z - start;
  decltype(bitsOf(Real(0))) longest[SIXTEEN]{};  // of every sixteenth
  forEachSixteen(
      particles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const Vec3<Real> a = load(x, y, z, i), b = load(x, y, z, i + other);
          const Vec3<Real> f = springForce(a, b, stiffness, rest[i]);
          const bool isCut = isCutAt<hasCuts>(cutMasks, i, place.bit);
          fx[i] = isCut ? Real(0) : f.x;
          fy[i] = isCut ? Real(0) : f.y;
          fz[i] = isCut ? Real(0) : f.z;
          longest[i - begin] = larger(longest[i - begin], bitsOf(isCut ? Real(0) : dot(b - a, b - a)));
        }
      });
  return largestOf(longest);
}

// Particles of the row whose own springs in `slot` are too long.
template <class Real>
[[gnu::noinline, gnu::cold]] void noteOverlong(const PassArguments<Real>& arguments, Range particles,
                                               SpringPlace place, Real maxSquared) {
  const Components<Real>& p = arguments.before.positions;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> d = load(p.x.data(), p.y.data(), p.z.data(), i + place.other) -
                         load(p.x.data(), p.y.data(), p.z.data(), i);
    const bool isCut = arguments.cutMasks != nullptr && isCutAt<true>(arguments.cutMasks, i, place.bit);
    if (!isCut && isBeyond(dot(d, d), maxSquared))
      noteDivergence(arguments.watch, PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  }
}

template <bool hasCuts, class Real>
INLINE void computeSprings(const PassArguments<Real>& arguments, std::uint32_t slot, int row,
                           ForceRows<Real>& rows) {
  const Arrays<Real> forces = rows.row(slot, row);
  const std::ptrdiff_t start = rangeOf(arguments.step, row).begin;
  const bool areThere = forEachStretch(
      arguments, row, slot,
      [&](Range particles, SpringPlace place, const SpringParams<Real>& spring, auto rest)
          __attribute__((always_inline)) {
            const auto longest =
                computeSprings<hasCuts>(arguments, particles, place, spring.stiffness, rest, forces, start);
            if (longest > bitsOf(spring.maxLengthSquared))
              noteOverlong(arguments, particles, place, spring.maxLengthSquared);
          });
  if (!areThere) rows.clear(slot, row);
}

// The same of all slots.
template <class Real>
[[gnu::noinline, gnu::cold]] void noteOverlong(const PassArguments<Real>& arguments, int row) {
  for (std::uint32_t slot = 0; slot < SPRING_SLOTS; ++slot)
    forEachStretch(arguments, row, slot,
                   [&](Range particles, SpringPlace place, const SpringParams<Real>& spring, auto) {
                     noteOverlong(arguments, particles, place, spring.maxLengthSquared);
                   });
}

// What sixteen particles side by side need of the springs that they own in a slot.
template <class Real, class RestLengths>
struct OwnSprings {
  std::ptrdiff_t other;             // from a particle to the other end
  Real stiffness, stiffnessOfEnds;  // of those inside, and of the first and the last particle of a row
  RestLengths rest;
  decltype(bitsOf(Real(0))) longest;  // bits of l^2
};
template <class Real, class RestLengths>
INLINE OwnSprings<Real, RestLengths> ownSprings(const StepParams<Real>& step, std::uint32_t slot, int row,
                                                RestLengths rest) {
  const SpringParams<Real>& spring = step.springs[slot];
  const bool isHalved = step.hasMaterial != 0 && slot == toLeft && isBorder(row, step.rows),
             areEndsHalved = step.hasMaterial != 0 && slot == toUpper;
  const Real halved = Real(0.5) * spring.stiffness;
  return {indexOffset(step, springOffsets[slot].columns, springOffsets[slot].rows),
          isHalved ? halved : spring.stiffness, isHalved || areEndsHalved ? halved : spring.stiffness, rest,
          bitsOf(spring.maxLengthSquared)};
}

// The forces of springs in the first slots, where nothing is cut. Returns whether one is too long.
template <class Real, class RestLengths, std::size_t... k>
INLINE bool computeOwnForces(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows,
                             const std::array<RestLengths, sizeof...(k)>& rests, std::index_sequence<k...>) {
  using Bits = decltype(bitsOf(Real(0)));
  const StepParams<Real>& step = arguments.step;
  const Range particles = rangeOf(step, row);
  const OwnSprings<Real, RestLengths> springs[]{ownSprings(step, k, row, rests[k])...};
  const Arrays<const Real> x = countedFrom(particles.begin, arraysOf(arguments.before.positions));
  Bits areTooLong[SIXTEEN]{};
  computeOwnSprings<sizeof...(k)>(
      rows, row, particles.end - particles.begin,
      [&](std::ptrdiff_t column) __attribute__((always_inline)) { return at(x, column); },
      [&](auto slot, std::ptrdiff_t column, int lane, Vec3<Real> a, bool isEnd,
          bool isThere) __attribute__((always_inline)) {
        const OwnSprings<Real, RestLengths> of = springs[slot];
        const Vec3<Real> b = at(x, column + of.other);
        const Vec3<Real> f = springForce(a, b, isEnd ? of.stiffnessOfEnds : of.stiffness, of.rest[column]);
        areTooLong[lane] |= (isThere & (bitsOf(dot(b - a, b - a)) > of.longest)) ? Bits(1) : Bits(0);
        return Vec3<Real>{isThere ? f.x : Real(0), isThere ? f.y : Real(0), isThere ? f.z : Real(0)};
      });
  return largestOf(areTooLong) != 0;
}
template <std::size_t slots, class Real>
INLINE bool computeOwnForces(const PassArguments<Real>& arguments, int row, ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step;
  const std::ptrdiff_t start = rangeOf(step, row).begin;
  return [&]<std::size_t... k>(std::index_sequence<k...> all) __attribute__((always_inline)) {
    if (step.useRestLengthTable == 0)
      return computeOwnForces(arguments, row, rows,
                              std::array{NominalLength<Real>{step.springs[k].restLength}...}, all);
    return computeOwnForces(arguments, row, rows,
                            std::array{arguments.restLengths + k * step.totalParticles + start...}, all);
  }
  (std::make_index_sequence<slots>());
}

// A row's forces of springs, where all slots behind the first ones are empty.
template <bool hasCuts, std::size_t slots, class Real>
INLINE void sumSpringForces(const PassArguments<Real>& arguments, int row, const Arrays<Real>& sums,
                            ForceRows<Real>& rows) {
  const StepParams<Real>& step = arguments.step;
  const auto count = static_cast<std::ptrdiff_t>(step.columns);
  const auto compute = [&](int owners) __attribute__((always_inline)) {
    // Of cut cloth slot by slot: all at once they would take half of this file's time to compile.
    if constexpr (!hasCuts)
      if (canComputeOwnSprings<slots>(step, owners)) {
        if (computeOwnForces<slots>(arguments, owners, rows)) noteOverlong(arguments, owners);
        return;
      }
    for (std::uint32_t slot = 0; slot < slots; ++slot) computeSprings<hasCuts>(arguments, slot, owners, rows);
    sumOwnSprings<slots>(rows, owners, count);
  };
  constexpr int reach = slots == SPRING_SLOTS ? 2 : 1;  // rows down to the farthest owner
  rows.ensure(ForceRows<Real>::OWN_SPRINGS, row, row + reach, compute);
  sumSprings<slots>(rows, row, sums, count);
}
template <bool hasCuts, class Real>
INLINE void sumSpringForces(const PassArguments<Real>& arguments, int row, const Arrays<Real>& sums,
                            ForceRows<Real>& rows) {
  hasSecondNeighbours(arguments.step) ? sumSpringForces<hasCuts, SPRING_SLOTS>(arguments, row, sums, rows)
                                      : sumSpringForces<hasCuts, NEIGHBOUR_SLOTS>(arguments, row, sums, rows);
}

}  // namespace clothsim::cpu
