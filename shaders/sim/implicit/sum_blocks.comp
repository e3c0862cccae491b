// Sums over blocks of 1024 particles, a work group each, in an order that depends on nothing (shared/implicit.h).
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
layout(std430, binding = PARTIAL_SUMS_BINDING) writeonly buffer PartialSums { vec4 partialSums[]; };

#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/lanes.glsl"

vec4 valueAt(int i) {
#if SUM_KIND == SUM_STEP
  return vec4(sumOfProducts(texelFetch(directions, i).xyz, texelFetch(products, i).xyz), 0.0, 0.0, 0.0);
#elif SUM_KIND == SUM_LENGTH
  return texelFetch(products, i);
#elif SUM_KIND == SUM_UPDATE
  vec3 update = texelFetch(increments, i).xyz, displacement = texelFetch(displacements, i).xyz;
  return vec4(sumOfProducts(update, update), sumOfProducts(displacement, displacement), 0.0, 0.0);
#else
  return vec4(sumOfProducts(texelFetch(residuals, i).xyz, texelFetch(corrections, i).xyz), 0.0, 0.0, 0.0);
#endif
}

void main() {
  if (isSkipped()) return;
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationID.x;
  precise vec4 sum = vec4(0.0);
  for (uint k = 0u; k < SUM_BLOCK; k += uint(SUM_LANES))
    if (first + k < step.totalParticles) sum = joined(sum, valueAt(int(first + k)));
  vec4 total = addLanes(sum);
  if (gl_LocalInvocationID.x == 0u) partialSums[gl_WorkGroupID.x] = total;
}
