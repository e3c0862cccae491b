// Corrections of the coarsest level, D^-1 r.
#include "sim/implicit/level.glsl"

layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

void main() {
  uvec2 coarse = gl_GlobalInvocationID.xy;
  if (coarse.x >= level.coarseColumns || coarse.y >= level.coarseRows) return;
  uint i = level.coarseFirst + coarse.y * level.coarseColumns + coarse.x;
  vec3 correction = solveFor(factorsAt(i), texelFetch(residuals, int(i)).xyz);
  newCorrections[i] = vec4(canonical(correction), 0.0);
}
