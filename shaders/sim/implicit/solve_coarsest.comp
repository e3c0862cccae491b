// Corrections of the coarsest level, A^-1 r, a vertex an invocation.
#include "shared/implicit.h"
#include "shared/step_params.h"
#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"

layout(local_size_x = 64) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(std140, binding = LEVEL_PARAMS_BINDING) uniform PartBlock { DensePart part; };
layout(binding = RESIDUALS_UNIT) uniform samplerBuffer residuals;
layout(binding = DENSE_UNIT) uniform samplerBuffer dense;
layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

vec3 threeAt(uint entry) {
  return vec3(texelFetch(dense, int(entry)).x, texelFetch(dense, int(entry) + 1).x, texelFetch(dense, int(entry) + 2).x);
}

void main() {
  if (isSkipped()) return;
  uint own = gl_GlobalInvocationID.x, order = 6u * part.count;
  if (own >= part.count) return;
  precise vec3 translation = vec3(0.0);
  precise vec3 rotation = vec3(0.0);
  for (uint j = 0u; j < order; ++j) {
    float r = texelFetch(residuals, int(step.totalParticles + VERTEX_TEXELS * part.first + j / 3u))[j % 3u];
    uint entry = part.firstEntry + j * order + 6u * own;
    translation = translation - r * threeAt(entry);
    rotation = rotation - r * threeAt(entry + 3u);
  }
  uint entry = step.totalParticles + VERTEX_TEXELS * (part.first + own);
  newCorrections[entry] = vec4(canonical(translation), 0.0);
  newCorrections[entry + 1u] = vec4(canonical(rotation), 0.0);
}
