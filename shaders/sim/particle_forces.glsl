// What the laws in shared/forces/ are written in, as GLSL, and the sum of those that act in this scene.
#ifndef LAW
#define LAW
#endif

struct ParticleForce {
  vec3 force;       // [N]
  float damping;    // [N s/m]
  float stiffness;  // [N/m]
};

#include "shared/forces.h"

bool acts(uint force) { return (particleForces >> force & 1u) != 0u; }

float massOf(float inverseMass) { return inverseMass == 0.0 ? 0.0 : reciprocal(inverseMass); }

vec3 addParticleForces(vec4 x, vec3 v, vec3 sum) {
  precise vec3 f = sum;
#define ADD_FORCE(number, Struct, sources, law) \
  if (acts(number))                             \
    for (uint source = 0u; source < sources; ++source) f = f + law(x.xyz, v, massOf(x.w), source).force;
  PARTICLE_FORCES(ADD_FORCE)
#undef ADD_FORCE
  return f;
}

// To the right-hand side of an implicit step and its diagonal (w); the velocity at its end is rate (d - carried),
// rate d where it is of first order.
vec4 addParticleForcesToSystem(vec3 x, vec3 v, float mass, float rate, bool isSecondOrder, vec3 carried, vec4 rightHandSide) {
  precise vec3 b = rightHandSide.xyz;
  precise float a = rightHandSide.w;
#define ADD_TO_SYSTEM(number, Struct, sources, law)              \
  if (acts(number))                                              \
    for (uint source = 0u; source < sources; ++source) {         \
      ParticleForce own = law(x, v, mass, source);               \
      precise float damping = own.damping * rate;                \
      b = b + (own.force + own.damping * v);                     \
      if (isSecondOrder) b = b + damping * carried;              \
      a = a + (damping + own.stiffness);                         \
    }
  PARTICLE_FORCES(ADD_TO_SYSTEM)
#undef ADD_TO_SYSTEM
  return vec4(b, a);
}
