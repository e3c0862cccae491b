// The forces that act on each particle by itself, as both backends know them: their numbers, and their laws.
// Each law is one text that compiles as GLSL (sim/particle_forces.glsl) and as C++, as a member of
// cpu::ForceLaws (solver/cpu/particle_forces.h), in the words of shared/shapes.h. It is given the particle's
// place x [m], velocity v [m/s] and mass [kg], and may read the parameters of the step, `step`. A force with
// several sources is called for one after the other, with its number.
//
// A law returns a ParticleForce: for a displacement d and a velocity v' at the end of an implicit step it
// stands for force - damping (v' - v) - stiffness d; an explicit step takes the force alone. Damping and
// stiffness must not be negative.

// Bits of StepParams.particleForces.
#define FORCE_AIR_RESISTANCE 0u
#define FORCE_ATTRACTORS 1u

#ifdef LAW
#include "shared/forces/air_resistance.h"
#include "shared/forces/attractors.h"
#endif

// EACH(number, struct that packs it (src/scene/forces/), number of sources, law)
#define PARTICLE_FORCES(EACH)                                  \
  EACH(FORCE_AIR_RESISTANCE, AirResistance, 1u, airResistance) \
  EACH(FORCE_ATTRACTORS, Attractors, step.attractorCount, attraction)
