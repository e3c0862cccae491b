// directions = corrections + kept * directions
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"

layout(std430, binding = DIRECTIONS_BINDING) writeonly buffer Directions { vec4 newDirections[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (!isParticle(i)) return;
  // The first direction is the correction alone: what lies in the buffer belongs to another Newton step.
  vec3 last = scalars.kept == 0.0 ? vec3(0.0) : texelFetch(directions, int(i)).xyz;
  precise vec3 p = texelFetch(corrections, int(i)).xyz + scalars.kept * last;
  newDirections[i] = vec4(canonical(p), iterateAt(i).w);
}
