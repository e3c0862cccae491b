// All forces on a particle but gravity: springs, bending, wind, and those on single particles [N].
#include "sim/incident_springs.glsl"
#include "sim/bending.glsl"
#include "sim/air.glsl"
#include "sim/particle_forces.glsl"
#if HAS_MESH
#include "sim/mesh.glsl"
#endif
#if HAS_SEAMS
#include "sim/seam_forces.glsl"
#endif

layout(binding = EXTERNAL_FORCES_UNIT) uniform samplerBuffer externalForces;

vec3 gatherForces(GridPoint p) {
#if HAS_MESH
  precise vec3 f = gatherMeshForces(p.index);
#else
  precise vec3 f = gatherSprings(p, positionAt(p.index).xyz);
  if (hasLimitSprings) f = addLimitSprings(p, f);
  if (hasMaterial) f = addBending(p, f);
  if (hasWind) f = addWind(p, f);
#endif
  f = addParticleForces(positionAt(p.index), velocityAt(p.index), f);
  if (hasExternalForces) f = f + texelFetch(externalForces, int(p.index)).xyz;
#if HAS_SEAMS
  f = addSeamForces(p.index, f);
#endif
  return f;
}

vec3 accelerationOf(vec3 force, float inverseMass) {
  precise vec3 acceleration = vec3(step.gravityX, step.gravityY, step.gravityZ) + inverseMass * force;
  return acceleration;
}
