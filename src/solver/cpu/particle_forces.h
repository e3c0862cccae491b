// What the laws in shaders/shared/forces/ are written in, as C++.
#pragma once

#include "core/exact_math.h"
#include "shared/step_params.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

template <class Real>
struct ParticleForce {
  Vec3<Real> force;  // [N]
  Real damping;      // [N s/m]
  Real stiffness;    // [N/m]
};

#define ParticleForce(force, damping, stiffness) \
  ParticleForce { force, damping, stiffness }
#include "solver/cpu/begin_laws.h"

template <class Real>
struct ForceLaws {
  using real = Real;
  using uint = std::uint32_t;
  using vec3 = Vec3<Real>;
  using ParticleForce = cpu::ParticleForce<Real>;

  const StepParams<Real>& step;

  INLINE static real sumOfProducts(vec3 a, vec3 b) { return dot(a, b); }
  INLINE static vec3 canonical(vec3 v) {
    return {clothsim::canonical(v.x), clothsim::canonical(v.y), clothsim::canonical(v.z)};
  }

// A law need not use all that it is given.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shared/forces.h"
#pragma GCC diagnostic pop
};

#include "solver/cpu/end_laws.h"
#undef ParticleForce

template <class Real>
INLINE Real massOf(Real inverseMass) {
  return inverseMass == Real(0) ? Real(0) : reciprocal(inverseMass);
}

// Calls use(law) for each source of each force that acts; law(x, v, mass) is a ParticleForce.
template <class Real, class Use>
INLINE void forEachParticleForce(const StepParams<Real>& step, Use use) {
  ForceLaws<Real> laws{step};
#define USE_SOURCES(number, Struct, sources, law)                \
  if ((step.particleForces >> (number)&1u) != 0)                 \
    for (std::uint32_t source = 0; source < (sources); ++source) \
      use([&](Vec3<Real> x, Vec3<Real> v, Real mass)             \
              __attribute__((always_inline)) { return laws.law(x, v, mass, source); });
  PARTICLE_FORCES(USE_SOURCES)
#undef USE_SOURCES
}

}  // namespace clothsim::cpu
