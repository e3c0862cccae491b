// How colliders push back in an implicit step (solver/implicit.h); the twin of
// shaders/sim/implicit/contact.glsl.
#pragma once

#include "solver/cpu/arrays.h"
#include "solver/cpu/implicit_laws.h"
#include "solver/cpu/implicit_passes.h"

namespace clothsim::cpu {

template <class Real>
INLINE bool hasContacts(const ImplicitArguments<Real>& arguments) {
  return arguments.step.step.colliderCount != 0;
}
// How stiffly a collider pushes back (CONTACT_OVER_INERTIA).
template <class Real>
INLINE Real contactStiffness(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i) {
  return Real(CONTACT_OVER_INERTIA) * arguments.own.diagonal.data()[i] + arguments.step.step.contactStiffness;
}
// How far a displacement d goes along the plane, relative to the collider.
template <class Real>
INLINE Vec3<Real> slipOf(const ContactPlanes<Real>& planes, std::ptrdiff_t i, Vec3<Real> d) {
  const Vec3<Real> normal = at(planes.normals, i), relative = d - at(planes.carries, i);
  return relative - dot(normal, relative) * normal;
}

// The nearest displacement that ends on the plane; d itself where there is none.
template <class Real>
INLINE Vec3<Real> onPlane(const ContactPlanes<Real>& planes, std::ptrdiff_t i, Vec3<Real> d) {
  const Vec3<Real> normal = at(planes.normals, i),
                   moved = d + (planes.offsets.data()[i] - dot(normal, d)) * normal;
  return dot(normal, normal) > Real(0) ? moved : d;
}

// Friction of a limit of 1 against a slip: its force over the slip, and how steeply the force rises along it.
// It is in full beyond `slow` (Li et al. 2020, "Incremental potential contact", equation 14).
template <class Real>
struct FrictionSlope {
  Real over, along;
};
template <class Real>
INLINE FrictionSlope<Real> frictionSlope(Real slip, Real inverseSlip, Real slow) {
  const Real inverseSlow = reciprocal(slow), part = slip * inverseSlow;
  const bool isSlow = slip < slow;
  return {isSlow ? inverseSlow * (Real(2) - part) : inverseSlip,
          isSlow ? inverseSlow * (Real(2) - Real(2) * part) : Real(0)};
}
// The potential of that force.
template <class Real>
INLINE Real frictionPotential(Vec3<Real> slip, Real slow) {
  const Real squared = dot(slip, slip), length = squared * inverseSquareRoot(squared),
             part = length * reciprocal(slow), third = static_cast<Real>(1.0f / 3);
  const Real rising = slow * ((part * part) * (Real(1) - third * part));
  return length < slow ? rising : length - third * slow;
}
template <class Real>
INLINE Real slowSlip(const StepParams<Real>& step) {
  return static_cast<Real>(SLOW_SLIP) * step.timeStep;
}

template <class Real>
INLINE bool frictionFollows(const ImplicitState<Real>& own) {
  return own.scalars.newtonSteps < FRICTION_FOLLOWS;
}

// What is remembered of a contact (LEAST_HELD), and the limit of friction that this says.
template <class Real>
INLINE Real heldLimit(bool holds, Real limit) {
  return holds ? larger(limit, Real(LEAST_HELD)) : Real(0);
}
template <class Real>
INLINE Real limitOf(Real held) {
  return held > Real(LEAST_HELD) ? held : Real(0);
}

// Which plane holds in this Newton step, and what friction does there. `residual` and `block` are those of
// the particle without contact, and become those with it.
//
// A plane holds what is across it, and what the particle's own Newton step would take there (the primal-dual
// active set of Hintermueller, Ito and Kunisch 2002, with the block as its constant): that the iterate is a
// hair outside decides nothing. In the first Newton step, what held when the last step ended does, too.
// Friction is limited by what the plane carries once both it and the block have given way: the whole push
// would count the part that the block's stiffness against bending takes, as if fabric weighed more on a plane
// that is softer. The force of friction is constant beyond `slow`, and its Hessian 0 along the slip; where
// that would turn a light particle round, a part of the secant's slope stands for it.
template <class Real>
INLINE void addContact(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i, Vec3<Real>& residual,
                       Symmetric<Real>& block) {
  ContactPlanes<Real>& planes = arguments.own.planes;
  const Vec3<Real> normal = at(planes.normals, i), d = at(arguments.own.displacements, i);
  const Real over = planes.offsets.data()[i] - dot(normal, d);
  const Real own = dot(normal, block * normal), push = own * over - dot(normal, residual);
  const Real before = arguments.own.scalars.newtonSteps == 0 ? planes.heldLimits.data()[i] : Real(0);
  const bool hasPlane = dot(normal, normal) > Real(0), presses = hasPlane && push > Real(0),
             held = hasPlane && before > Real(0), holds = presses || held || (hasPlane && over > Real(0));
  const Real stiffness = holds ? contactStiffness(arguments, i) : Real(0),
             carried = push * (stiffness * reciprocal(stiffness + own)),
             most = presses ? planes.frictions.data()[i] * carried : Real(0),
             limit = held                             ? limitOf(before)
                     : frictionFollows(arguments.own) ? most
                                                      : planes.limits.data()[i];
  const Vec3<Real> slip = slipOf(planes, i, d);
  const Real squared = dot(slip, slip), inverse = inverseSquareRoot(squared);
  const FrictionSlope<Real> slope = frictionSlope(squared * inverse, inverse, slowSlip(arguments.step.step));
  const Real across = limit * slope.over, secant = across - Real(LIGHT) * arguments.own.diagonal.data()[i],
             along = larger(larger(secant, Real(0)), limit * slope.along);
  Symmetric<Real> contact =
      outerProduct(stiffness - across, normal) + outerProduct(along - across, inverse * slip);
  contact.diagonal = contact.diagonal + Vec3<Real>{across, across, across};
  residual = residual + ((stiffness * over) * normal - across * slip);
  block = block + contact;
  put(planes.blocks, i, contact);
  planes.limits.data()[i] = limit;
}

// An increment e of a particle at the displacement d, which ends on its plane where it would cross it and the
// plane does not hold it: the linear system knows nothing of that plane (projected Newton steps: Bertsekas
// 1982, "Projected Newton methods for optimization problems with simple constraints"). Without this the line
// search would cut the whole step short for a few particles.
template <class Real>
INLINE Vec3<Real> stoppedAtPlane(const ContactPlanes<Real>& planes, std::ptrdiff_t i, Vec3<Real> d,
                                 Vec3<Real> e) {
  const Vec3<Real> normal = at(planes.normals, i), held = at(planes.blocks, i).diagonal;
  const Real over = planes.offsets.data()[i] - dot(normal, d), after = over - dot(normal, e);
  const bool crosses = !((held.x + held.y) + held.z > Real(0)) && after > Real(0);
  return selected(crosses, e + after * normal, e);
}

// How the energy changes when what crosses a plane, `over` deep, moves on to `overAfter`.
template <class Real>
INLINE Real contactChange(Real stiffness, Real over, Real overAfter) {
  const Real before = larger(over, Real(0)), after = larger(overAfter, Real(0));
  return Real(0.5) * ((stiffness * (after - before)) * (after + before));
}

template <class Real>
INLINE Vec3<Real> tangential(Vec3<Real> normal, Vec3<Real> d) {
  return d - dot(normal, d) * normal;
}

// A sum over the four particles of a pair, each with its weight.
template <class Real>
INLINE Vec3<Real> weighted(const SurfacePair<Real>& pair, const Components<Real>& c) {
  const auto& [a, b, d, e] = pair.particles;
  return ((pair.weights[0] * at(c, a) + pair.weights[1] * at(c, b)) + pair.weights[2] * at(c, d)) +
         pair.weights[3] * at(c, e);
}
template <class Visit>
INLINE void forEachPairOf(const PairLists& lists, std::ptrdiff_t i, Visit visit) {
  if (lists.entries.empty()) return;
  for (std::uint32_t k = lists.starts.data()[i]; k < lists.starts.data()[i + 1]; ++k)
    visit(lists.entries[k] / 4, lists.entries[k] % 4);
}
template <class Real>
INLINE Vec3<Real> forceOfPairs(const TouchingPairs<Real>& touching, std::ptrdiff_t i) {
  Vec3<Real> force{};
  forEachPairOf(touching.ofActing, i, [&](std::uint32_t q, std::uint32_t place) {
    force = force + touching.pairs[q].weights[place] * touching.forces[q];
  });
  return force;
}
template <class Real>
INLINE void addPairs(const TouchingPairs<Real>& touching, std::ptrdiff_t i, Vec3<Real>& residual,
                     Symmetric<Real>& block) {
  forEachPairOf(touching.ofActing, i, [&](std::uint32_t q, std::uint32_t place) {
    const SurfacePair<Real>& pair = touching.pairs[q];
    const Real weight = pair.weights[place], square = weight * weight, across = square * pair.across;
    residual = residual + weight * touching.forces[q];
    block = block + outerProduct(square * (pair.held - pair.across), pair.normal);
    block.diagonal = block.diagonal + Vec3<Real>{across, across, across};
  });
}
// How the energies of the pairs whose first particle this is change along the increments.
template <class Real>
INLINE void addPairTrials(ImplicitState<Real>& own, std::ptrdiff_t i, Real slow) {
  forEachPairOf(own.touching.all, i, [&](std::uint32_t q, std::uint32_t place) {
    if (place != 0) return;
    const SurfacePair<Real>& pair = own.touching.pairs[q];
    const Vec3<Real> d = weighted(pair, own.displacements), e = weighted(pair, own.increments);
    const Real along = dot(pair.normal, d), fall = dot(pair.normal, e), over = pair.over - along;
    const Vec3<Real> slip = tangential(pair.normal, d - own.touching.carries[q]),
                     slide = e - fall * pair.normal;
    const Real resisted = frictionPotential(slip, slow);
    forEachLength(own, [&](Real* trial, Real l) {
      trial[i] = trial[i] + (contactChange(pair.stiffness, over, over - l * fall) +
                             pair.limit * (frictionPotential(slip + l * slide, slow) - resisted));
    });
  });
}

}  // namespace clothsim::cpu
