// Residuals of a coarse level, P^T r.
#include "sim/implicit/level.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };

void main() {
  uvec2 coarse = gl_GlobalInvocationID.xy;
  if (coarse.x >= level.coarseColumns || coarse.y >= level.coarseRows) return;
  vec3 sum = gatherFine(residuals, fineAround(coarse), 1u, 0u);
  newResiduals[level.coarseFirst + coarse.y * level.coarseColumns + coarse.x] = vec4(canonical(sum), 0.0);
}
