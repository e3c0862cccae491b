// Pairs of parts of the surface that may touch: what they are to an implicit step.
#pragma once

#include <array>

#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/surface_search.h"
#include "solver/surface.h"

namespace clothsim::cpu {

// Of the particles in the way between the parts.
template <class Real>
INLINE std::array<Real, 4> weightsOf(const Parts& parts,
                                     const typename SurfaceLaws<Real>::NearestParts& nearest) {
  const Real u = nearest.u, v = nearest.v, rest = Real(1) - u;
  return {parts.areSides ? canonical(rest) : Real(1), canonical(parts.areSides ? u : v - rest),
          canonical(parts.areSides ? v - Real(1) : -u), canonical(-v)};
}

template <class Real>
INLINE typename SurfaceLaws<Real>::NearestParts nearestOf(const Parts& parts, const Components<Real>& x) {
  const auto& [i, j, k, l] = parts.particles;
  return SurfaceLaws<Real>::nearestParts(parts.areSides, at(x, i), at(x, j), at(x, k), at(x, l));
}

// The pair of parts that may touch, which are `nearest` at the start; without stiffness where they do not.
// Where they surely pass each other on the way that is predicted, it is as it will be at its end: what slides
// over a border, or past a corner, does not run into it. There is none where they have left each other behind
// by then: it would be a bump for what comes less far.
template <class Real>
[[nodiscard]] SurfacePair<Real> pairOf(const ClothSurface<Real>& surface, const Parts& parts,
                                       const typename SurfaceLaws<Real>::NearestParts& nearest,
                                       const Components<Real>& x, const ImplicitState<Real>& implicit,
                                       bool isLater);
// The list of each particle's pairs, of those that may touch.
template <class Real>
void listPairs(TouchingPairs<Real>& touching, std::size_t particles);
// Forces of the pairs at the iterate, and what they add to the Hessian.
template <class Real>
void weighPairs(ImplicitState<Real>& own, const StepParams<Real>& step);
// What friction of the pairs remembers: as they begin with it, and as the step leaves it.
template <class Real>
void recallSlips(ImplicitState<Real>& own);
template <class Real>
void keepSlips(ImplicitState<Real>& own, const StepParams<Real>& step);
// What the pairs do to the directions.
template <class Real>
void multiplyPairs(ImplicitState<Real>& own);

}  // namespace clothsim::cpu
