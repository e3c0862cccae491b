// Corrections of the coarsest level, A^-1 r, a vertex an invocation, a connected part a work group.
#include "sim/implicit/vectors.glsl"
#include "sim/implicit/vertices.glsl"

layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

RigidVector residualOn(uint coarse) { return rigidAt(residuals, coarse); }
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
