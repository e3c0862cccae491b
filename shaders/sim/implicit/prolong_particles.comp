// Corrections z of all particles, and r.z (sim/implicit/total.glsl). With UPDATES_SOLUTION, increments and residuals first:
// increments += stepSize * directions, residuals -= stepSize * products.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/vertices.glsl"
#include "sim/implicit/updated_solution.glsl"
#include "sim/implicit/total.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };
layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };
layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

RigidVector correctionOn(uint coarse) { return rigidAt(corrections, coarse); }
#include "sim/implicit/prolongation.glsl"

float residualTimesCorrection(uint i) {
#if UPDATES_SOLUTION
  vec3 residual = updatedResidual(i);
  newResiduals[i] = vec4(residual, 0.0);
  newIncrements[i] = vec4(updatedIncrement(i), 0.0);
#else
  vec3 residual = texelFetch(residuals, int(i)).xyz;
#endif
  vec3 correction = correctionOfParticle(i, residual);
  newCorrections[i] = vec4(correction, 0.0);
  return sumOfProducts(residual, correction);
}

void main() {
  if (isSkipped()) return;
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationIndex;
  precise float sum = 0.0;
  for (uint k = 0u; k < SUM_BLOCK; k += uint(SUM_LANES))
    if (first + k < step.totalParticles) sum = joined(sum, residualTimesCorrection(first + k));
  addToTotal(sum);
}
