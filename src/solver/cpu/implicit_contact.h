// How colliders push back in an implicit step (solver/implicit.h); the twin of
// shaders/sim/implicit/contact.glsl.
#pragma once

#include "solver/cpu/arrays.h"
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
// With what force along the plane's normal, for a displacement d; 0 where nothing is touched [N].
template <class Real>
INLINE Real contactPush(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i, Vec3<Real> d) {
  const ContactPlanes<Real>& planes = arguments.own.planes;
  const Vec3<Real> normal = at(planes.normals, i);
  const bool touches = dot(normal, normal) > Real(0);
  const Real push = contactStiffness(arguments, i) * (planes.offsets.data()[i] - dot(normal, d));
  return touches ? push : Real(0);
}

// How far a displacement d goes along the plane, relative to the collider.
template <class Real>
INLINE Vec3<Real> slipOf(const ContactPlanes<Real>& planes, std::ptrdiff_t i, Vec3<Real> d) {
  const Vec3<Real> normal = at(planes.normals, i), relative = d - at(planes.carries, i);
  return relative - dot(normal, relative) * normal;
}
// Adds what touching adds to a product of the Hessian: across the plane, and along it.
template <class Real>
INLINE Vec3<Real> contactProduct(const ImplicitArguments<Real>& arguments, std::ptrdiff_t i, Vec3<Real> p) {
  const ContactPlanes<Real>& planes = arguments.own.planes;
  const Vec3<Real> normal = at(planes.normals, i);
  const Real grip = planes.grips.data()[i];
  return grip * p + ((contactStiffness(arguments, i) - grip) * dot(normal, p)) * normal;
}

// How the energy changes when what crosses the last plane, `over` deep, moves on to `overAfter`.
template <class Real>
INLINE Real contactChange(Real stiffness, Real over, Real overAfter) {
  const Real before = larger(over, Real(0)), after = larger(overAfter, Real(0));
  return Real(0.5) * ((stiffness * (after - before)) * (after + before));
}

}  // namespace clothsim::cpu
