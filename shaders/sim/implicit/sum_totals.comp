// Adds the sums of the blocks, and does with the total what conjugate gradients or the line search do.
#include "shared/implicit.h"
#include "shared/step_params.h"

layout(local_size_x = SUM_LANES) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(binding = PARTIAL_SUMS_UNIT) uniform samplerBuffer partialSums;
layout(std430, binding = SCALARS_BINDING) buffer Scalars { ImplicitScalars scalars; };

#include "sim/exact_math.glsl"
#include "sim/implicit/lanes.glsl"

// a / b; 0 where b is none or too small for a reciprocal.
float quotient(float a, float b) {
  precise float result = a * reciprocal(b);
  return b > uintBitsToFloat(0x08800000u) ? result : 0.0;  // 2^-110
}

void main() {
#if GATE != GATE_NONE
  if (scalars.isStepSolved != 0u || (GATE == GATE_SYSTEM && scalars.isSystemSolved != 0u)) return;
#endif
  uint blocks = (step.totalParticles + SUM_BLOCK - 1u) / SUM_BLOCK;
  precise vec4 sum = vec4(0.0);
  for (uint block = gl_LocalInvocationID.x; block < blocks; block += uint(SUM_LANES))
    sum = joined(sum, texelFetch(partialSums, int(block)));
  vec4 total = addLanes(sum);
  if (gl_LocalInvocationID.x != 0u) return;
#if SUM_KIND == SUM_FIRST
  float residual = total.x < 0.0 ? 0.0 : total.x;
  precise float least = step.systemTolerance * residual;
  scalars.residual = residual;
  scalars.leastResidual = least;
  scalars.kept = 0.0;
#elif SUM_KIND == SUM_STEP
  scalars.stepSize = quotient(scalars.residual, total.x);
  scalars.iterations += 1u;
#elif SUM_KIND == SUM_NEXT
  float residual = total.x < 0.0 ? 0.0 : total.x;
  scalars.kept = quotient(residual, scalars.residual);
  scalars.residual = residual;
  scalars.isSystemSolved = residual <= scalars.leastResidual ? 1u : 0u;
#elif SUM_KIND == SUM_UPDATE
  precise float leastMotion = step.leastMotion * step.leastMotion;
  float motion = total.y < leastMotion ? leastMotion : total.y;
  precise float square = total.x * reciprocal(motion);
  precise float update = square * inverseSquareRoot(square);
  scalars.lastUpdate = update;
  bool isConfirmed = step.colliderCount == 0u || scalars.newtonSteps > 0u;  // the first one takes predicted contacts
  scalars.isStepSolved = isConfirmed && update <= step.tolerance ? 1u : 0u;
  scalars.isSystemSolved = 0u;
  scalars.newtonSteps += 1u;
#else
  scalars.newtonLength = total.x <= 0.0 ? 1.0 : total.y <= 0.0 ? 0.5 : total.z <= 0.0 ? 0.25 : 0.125;
#endif
}
