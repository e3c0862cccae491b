// Where the search starts, as an increment: what of its fall was not held up in the step before (src/solver/implicit.h).
#include "sim/implicit/common.glsl"

layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 velocity = texelFetch(velocities, int(p.index));
  precise float falls = 1.0 - velocity.w;
  precise vec3 displacement = step.guessTime * (velocity.xyz + (falls * step.timeStep) * vec3(step.gravityX, step.gravityY, step.gravityZ));
  newIncrements[p.index] = vec4(texelFetch(starts, int(p.index)).w == 0.0 ? vec3(0.0) : canonical(displacement), 0.0);
}
