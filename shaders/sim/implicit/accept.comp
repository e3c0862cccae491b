// displacements += newtonLength * increments; as a sum, with the largest of both (sim/implicit/total.glsl).
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#if IS_SUM
#include "sim/implicit/total.glsl"
#endif

layout(std430, binding = DISPLACEMENTS_BINDING) writeonly buffer Displacements { vec4 newDisplacements[]; };
layout(std430, binding = ITERATES_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };

vec3 accepted(uint i, vec3 increment) {
  vec4 start = texelFetch(starts, int(i));
  precise vec3 moved = texelFetch(displacements, int(i)).xyz + scalars.newtonLength * increment;
  vec3 displacement = canonical(moved);
  precise vec3 place = start.xyz + displacement;
  newDisplacements[i] = vec4(displacement, 0.0);
  newIterates[i] = vec4(canonical(place), start.w);
  return displacement;
}

vec3 incrementAt(uint i) { return texelFetch(increments, int(i)).xyz; }

void main() {
  if (isSkipped()) return;
#if IS_SUM
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationIndex;
  Sum largest = Sum(0.0);
  for (uint i = first; i < first + SUM_BLOCK && i < step.totalParticles; i += uint(SUM_LANES)) {
    vec3 increment = incrementAt(i);
    largest = joined(largest, squaresOf(increment, accepted(i, increment)));
  }
  addToTotal(largest);
#else
  uint i = thisParticle();
  if (isParticle(i)) accepted(i, incrementAt(i));
#endif
}
