// Sums over all particles of what lies in arrays (sim/implicit/total.glsl).
#include "shared/implicit.h"
#include "shared/step_params.h"

layout(local_size_x = SUM_LANES) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(binding = RESIDUALS_UNIT) uniform samplerBuffer residuals;
layout(binding = CORRECTIONS_UNIT) uniform samplerBuffer corrections;
layout(binding = DIRECTIONS_UNIT) uniform samplerBuffer directions;
layout(binding = PRODUCTS_UNIT) uniform samplerBuffer products;
layout(binding = INCREMENTS_UNIT) uniform samplerBuffer increments;
layout(binding = DISPLACEMENTS_UNIT) uniform samplerBuffer displacements;

#include "sim/implicit/scalars.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/total.glsl"

Sum valueAt(int i) {
#if SUM_KIND == SUM_STEP
  return sumOfProducts(texelFetch(directions, i).xyz, texelFetch(products, i).xyz);
#elif SUM_KIND == SUM_LENGTH
  return texelFetch(products, i);
#elif SUM_KIND == SUM_UPDATE
  return squaresOf(texelFetch(increments, i).xyz, texelFetch(displacements, i).xyz);
#else
  return sumOfProducts(texelFetch(residuals, i).xyz, texelFetch(corrections, i).xyz);
#endif
}

void main() {
  if (isSkipped()) return;
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationID.x;
  precise Sum sum = Sum(0.0);
  for (uint k = 0u; k < SUM_BLOCK; k += uint(SUM_LANES))
    if (first + k < step.totalParticles) sum = joined(sum, valueAt(int(first + k)));
  addToTotal(sum);
}
