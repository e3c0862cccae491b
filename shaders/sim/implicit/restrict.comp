// Force and torque on the aggregates of a level, P^T r.
#include "sim/implicit/level.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.coarseCount)) return;
  uint coarse = level.coarseFirst + i;
  vec3 center = centerAt(coarse);
  precise vec3 forces = vec3(0.0);
  precise vec3 torques = vec3(0.0);
  uvec2 range = rangeAt(restrictionStarts, coarse);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(restriction, n);
    bool isParticle = weight.vertex < step.totalParticles;
    RigidVector force = isParticle ? RigidVector(texelFetch(residuals, int(weight.vertex)).xyz, vec3(0.0))
                                   : rigidAt(residuals, weight.vertex - step.totalParticles);
    precise vec3 arm = placeOf(weight.vertex) - center;
    precise vec3 torque = crossProduct(arm, force.translation) + force.rotation;
    forces = forces + weight.weight * force.translation;
    torques = torques + weight.weight * torque;
  }
  int entry = entryOfVertex(coarse);
  newResiduals[entry] = vec4(canonical(forces), 0.0);
  newResiduals[entry + 1] = vec4(canonical(torques), 0.0);
}
