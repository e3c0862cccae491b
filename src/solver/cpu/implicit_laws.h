// What a spring is to the implicit integrator, on a grid and on lists alike; the twin of what is in
// shaders/sim/incident_springs.glsl and shaders/sim/implicit/energy.glsl.
#pragma once

#include <array>
#include <type_traits>

#include "core/exact_math.h"
#include "core/vec.h"
#include "shared/implicit.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// The Hessian of a spring between particles d apart, projected or exact: across 1 + along d d^T.
template <class Real>
struct SpringBlock {
  Real across, along;
};
template <class Real>
INLINE SpringBlock<Real> springBlock(Vec3<Real> d, Real stiffness, Real restLength, Real limitStiffness,
                                     Real limitLength, bool isExact = false) {
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real over = length - limitLength;
  const bool beyond = over > Real(0);
  const Real tension = stiffness * (length - restLength);
  const Real tensionBeyond = tension + limitStiffness * over, wholeBeyond = stiffness + limitStiffness;
  const Real whole = beyond ? wholeBeyond : stiffness;
  const Real scale = (beyond ? tensionBeyond : tension) * inverseLength;
  const Real across = isExact || scale > Real(0) ? scale : Real(0);
  return {across, (whole - across) * (inverseLength * inverseLength)};
}

// How the energy changes when a spring of ends d apart is moved by l e; exact where that is little.
template <class Real>
INLINE Real springChange(Vec3<Real> d, Vec3<Real> e, Real l, Real stiffness, Real restLength,
                         Real limitStiffness, Real limitLength) {
  const Vec3<Real> moved = d + l * e;
  const Real squaredBefore = dot(d, d), squaredAfter = dot(moved, moved);
  const Real before = squaredBefore * inverseSquareRoot(squaredBefore);
  const Real after = squaredAfter * inverseSquareRoot(squaredAfter);
  const Real sum = (before + after) + static_cast<Real>(0x1p-100f);
  const Real change = (l * (Real(2) * dot(d, e) + l * dot(e, e))) * reciprocal(sum);
  const Real spring = (stiffness * change) * ((before - restLength) + (after - restLength));
  const Real overBefore = larger(before - limitLength, Real(0)),
             overAfter = larger(after - limitLength, Real(0));
  const Real limit = (limitStiffness * (overAfter - overBefore)) * (overAfter + overBefore);
  return Real(0.5) * (spring + limit);
}

template <class Real>
INLINE Real lengthTried(std::size_t k) {
  constexpr std::array<Real, LENGTHS_TRIED> lengths{Real(1), Real(0.5), Real(0.25), Real(0.125)};
  return lengths[k];
}
// Calls add(trial, l) for the lengths that are tried now: l, and what particles sum up for it.
template <class State, class Add>
INLINE void forEachLength(State& own, Add add) {
  using Real = std::remove_reference_t<decltype(own.trials[0][0])>;
  for (std::size_t k = own.triesShorter ? 1 : 0; k < (own.triesShorter ? LENGTHS_TRIED : 1); ++k)
    add(own.trials[k].data(), lengthTried<Real>(k));
}

}  // namespace clothsim::cpu
