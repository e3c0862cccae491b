// Force and torque on the aggregates of a level.
#include "sim/implicit/level.glsl"
#include "sim/implicit/vectors.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };

vec3 residualAt(uint i) { return texelFetch(residuals, int(i)).xyz; }
RigidVector residualOn(uint coarse) { return rigidAt(residuals, coarse); }
#include "sim/implicit/restriction.glsl"

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.coarseCount)) return;
  uint coarse = level.coarseFirst + i;
  RigidVector force = restricted(coarse);
  int entry = entryOfVertex(coarse);
  newResiduals[entry] = vec4(force.translation, 0.0);
  newResiduals[entry + 1] = vec4(force.rotation, 0.0);
}
