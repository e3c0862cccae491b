// displacements += newtonLength * increments
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"

layout(std430, binding = DISPLACEMENTS_BINDING) writeonly buffer Displacements { vec4 newDisplacements[]; };
layout(std430, binding = ITERATES_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (!isParticle(i)) return;
  vec4 start = texelFetch(starts, int(i));
  precise vec3 moved = texelFetch(displacements, int(i)).xyz + scalars.newtonLength * texelFetch(increments, int(i)).xyz;
  vec3 displacement = canonical(moved);
  precise vec3 place = start.xyz + displacement;
  newDisplacements[i] = vec4(displacement, 0.0);
  newIterates[i] = vec4(canonical(place), start.w);
}
