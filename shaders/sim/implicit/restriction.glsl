// Force and torque on an aggregate, P^T r. Needs residualAt(particle) and residualOn(coarse vertex).
#include "sim/implicit/restriction_lists.glsl"

RigidVector restricted(uint coarse) {
  vec3 center = centerAt(coarse);
  precise vec3 forces = vec3(0.0);
  precise vec3 torques = vec3(0.0);
  uvec2 range = rangeAt(restrictionStarts, coarse);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(restriction, n);
    bool isParticle = weight.vertex < step.totalParticles;
    RigidVector force = isParticle ? RigidVector(residualAt(weight.vertex), vec3(0.0)) : residualOn(weight.vertex - step.totalParticles);
    precise vec3 arm = placeOf(weight.vertex) - center;
    precise vec3 torque = crossProduct(arm, force.translation) + force.rotation;
    forces = forces + weight.weight * force.translation;
    torques = torques + weight.weight * torque;
  }
  return RigidVector(canonical(forces), canonical(torques));
}
