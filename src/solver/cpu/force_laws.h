// What springs and air do, on a grid and on lists alike; the twin of what is in
// shaders/sim/{springs,grab,air}.glsl.
#pragma once

#include "core/exact_math.h"
#include "core/vector_clones.h"
#include "solver/interaction.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

// Hooke's law: k (l - L) along the unit vector from a to b.
template <class Real>
INLINE Vec3<Real> springForce(Vec3<Real> a, Vec3<Real> b, Real stiffness, Real restLength) {
  const Vec3<Real> d = b - a;
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real scale = (stiffness * (length - restLength)) * inverseLength;
  return scale * d;
}

// What of the jet arrives at x, 0 to 1 (solver/interaction.h).
template <class Real>
INLINE Real jetShare(const InteractionParams<Real>& interaction, Vec3<Real> x) {
  const Vec3<Real> direction{interaction.directionX, interaction.directionY, interaction.directionZ};
  const Vec3<Real> d = x - Vec3<Real>{interaction.originX, interaction.originY, interaction.originZ};
  const Real along = dot(d, direction);
  const Vec3<Real> across = d - along * direction;
  const Real inside = Real(1) - interaction.inverseRadiusSquared * dot(across, across);
  const Real rise = interaction.inverseRadius * along;
  const Real risen = rise < Real(1) ? rise : Real(1);
  const Real share = (inside * inside) * risen;
  const bool reached = (inside > Real(0)) & (rise > Real(0));
  return reached ? canonical(share) : Real(0);
}

// A third of the force of the air on triangle (a, b, c): pressure along its normal, rho C_d / 2 A (u.n)|u.n|
// n, and lift across the relative wind u, rho C_l / 2 A |u|^2 (e.n) (n - (e.n) e) with e = u/|u|. `normal` is
// 2 A n, and the factors of the step hold rho C / 12. Both terms are even in n: it does not matter to which
// side it points. Pressure p behind the cloth adds p A/3 n.
//
// `resistance` is r of the matrix r n n^T, with `normal` for n, by which a third of the triangle resists a
// change of its velocity, as far as the implicit integrator takes the pressure for linear: with |u.n| as it
// is.
template <class Real>
struct TriangleWind {
  Vec3<Real> force, normal;
  Real resistance;
};
template <bool jet, class Real>
INLINE TriangleWind<Real> windOn(const StepParams<Real>& step, const InteractionParams<Real>& interaction,
                                 Vec3<Real> a, Vec3<Real> b, Vec3<Real> c, Vec3<Real> va, Vec3<Real> vb,
                                 Vec3<Real> vc) {
  constexpr Real third = static_cast<Real>(1.0 / 3.0);
  const Vec3<Real> normal = cross(b - a, c - a);
  const Real normalSquared = dot(normal, normal);
  const Real inverseNormal = inverseSquareRoot(normalSquared);
  Vec3<Real> air{step.airVelocityX, step.airVelocityY, step.airVelocityZ};
  Real share = 0;
  if constexpr (jet) {
    share = jetShare(interaction, third * ((a + b) + c));
    const Real jetSpeed = share * interaction.jetSpeed;
    air = air + jetSpeed * Vec3<Real>{interaction.directionX, interaction.directionY, interaction.directionZ};
  }
  const Vec3<Real> u = air - third * ((va + vb) + vc);
  const Real speedSquared = dot(u, u);
  const Real inverseSpeed = inverseSquareRoot(speedSquared);
  const Real speed = speedSquared * inverseSpeed;
  const Real through = dot(u, normal);
  const Real across = through * inverseNormal;  // u.n
  const Real acrossMagnitude = across < Real(0) ? -across : across;
  const Real alongNormal = step.dragFactor * (across * acrossMagnitude) + step.liftFactor * (across * speed);
  const Real alongWind = step.liftFactor * ((across * through) * inverseSpeed);
  Vec3<Real> force = alongNormal * normal - alongWind * u;
  if constexpr (jet) {
    const Vec3<Real> part = share * force;
    const bool alone = interaction.jetAlone != 0;
    force = {alone ? part.x : force.x, alone ? part.y : force.y, alone ? part.z : force.z};
  }
  Real resistance = (step.dragFactor * acrossMagnitude) * inverseNormal;
  if constexpr (jet) {
    const Real part = share * resistance;
    resistance = interaction.jetAlone != 0 ? part : resistance;
  }
  force = force + step.pressureFactor * normal;
  const bool degenerate = normalSquared < static_cast<Real>(0x1p-100);
  return {{degenerate ? Real(0) : force.x, degenerate ? Real(0) : force.y, degenerate ? Real(0) : force.z},
          {normal.x, normal.y, normal.z},  // a structure that is copied whole keeps GCC 12 from vectors
          degenerate ? Real(0) : resistance};
}

}  // namespace clothsim::cpu
