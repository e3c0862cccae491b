// ways += newtonLength * increments
#include "sim/implicit/common.glsl"
#include "sim/implicit/scalars.glsl"

layout(std430, binding = FIRST_OUTPUT_BINDING) writeonly buffer Ways { vec4 newWays[]; };
layout(std430, binding = SECOND_OUTPUT_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };

void main() {
  uint i = thisParticle();
  if (!isParticle(i)) return;
  vec4 start = texelFetch(starts, int(i));
  precise vec3 moved = texelFetch(ways, int(i)).xyz + scalars.newtonLength * texelFetch(increments, int(i)).xyz;
  vec3 way = canonical(moved);
  precise vec3 place = start.xyz + way;
  newWays[i] = vec4(way, 0.0);
  newIterates[i] = vec4(canonical(place), start.w);
}
