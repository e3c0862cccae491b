// Corrections of the coarsest level, A^-1 r, a vertex an invocation, a connected part a work group.
#include "shared/implicit.h"
#include "shared/step_params.h"
#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/rigid_block.glsl"

layout(local_size_x = 64) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(binding = RESIDUALS_UNIT) uniform samplerBuffer residuals;
layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

RigidVector residualOn(uint coarse) {
  int i = int(step.totalParticles + VERTEX_TEXELS * coarse);
  return RigidVector(texelFetch(residuals, i).xyz, texelFetch(residuals, i + 1).xyz);
}
#include "sim/implicit/dense.glsl"

void main() {
  if (isSkipped()) return;
  uint own = gl_LocalInvocationID.x;
  for (uint number = gl_WorkGroupID.x; number < densePartCount(); number += gl_NumWorkGroups.x) {
    DensePart part = densePartAt(number);
    if (own >= part.count) continue;
    RigidVector correction = solvedFor(part, own);
    uint entry = step.totalParticles + VERTEX_TEXELS * (part.first + own);
    newCorrections[entry] = vec4(correction.translation, 0.0);
    newCorrections[entry + 1u] = vec4(correction.rotation, 0.0);
  }
}
