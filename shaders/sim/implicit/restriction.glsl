// Force and torque on an aggregate, P^T r. Needs residualAt(particle) and residualOn(coarse vertex).
#include "sim/implicit/restriction_lists.glsl"

RigidVector forceOn(uint vertex) {
  if (vertex >= step.totalParticles) return residualOn(vertex - step.totalParticles);
  vec3 force = residualAt(vertex);
  return RigidVector(force, crossProduct(fromOrigin(iterateAt(vertex).xyz), force));
}

RigidVector restricted(uint coarse) {
  precise vec3 forces = vec3(0.0);
  precise vec3 torques = vec3(0.0);
  uvec2 range = rangeAt(restrictionStarts, coarse);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(restriction, n);
    RigidVector force = forceOn(weight.vertex);
    forces = forces + weight.weight * force.translation;
    torques = torques + weight.weight * force.rotation;
  }
  return RigidVector(canonical(forces), canonical(torques));
}
