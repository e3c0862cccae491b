// Limit: no spring longer than the strain limit allows. One dispatch a colour; springs of a colour share no particle, so
// each works in place.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/limit.glsl"

layout(std140, binding = LIMIT_COLOR_BINDING) uniform ColorBlock { LimitColor color; };

#if HAS_MESH
#include "shared/mesh_lists.h"
layout(binding = LIMITED_SPRINGS_UNIT) uniform usamplerBuffer limitedSprings;
#endif

struct LimitedSpring {
  uint a, b;  // the owner, and the other end
  float limit;
  bool exists;
};

LimitedSpring thisSpring() {
#if HAS_MESH
  uint number = color.firstColumn + gl_GlobalInvocationID.x;
  if (number >= color.endColumn || gl_GlobalInvocationID.y > 0u) return LimitedSpring(0u, 0u, 0.0, false);
  uvec4 spring = texelFetch(limitedSprings, int(number));
  precise float limit = step.limitFactor * uintBitsToFloat(spring.z);
  return LimitedSpring(spring.x, spring.y, limit, true);
#else
  uvec2 n = gl_GlobalInvocationID.xy;
  uint column = color.firstColumn + color.columnStep * (n.x / color.columnRun) + n.x % color.columnRun;
  uint row = color.firstRow + color.rowStep * (n.y / color.rowRun) + n.y % color.rowRun;
  if (column >= color.endColumn || row >= color.endRow) return LimitedSpring(0u, 0u, 0.0, false);
  uint a = step.firstParticle + row * step.columns + column;
  ivec2 offset = toOtherEnd[color.slot];
  uint b = uint(int(a) + offset.x + offset.y * int(step.columns));
  return LimitedSpring(a, b, longestOf(color.slot, a), isIntact(cutMaskOf(a), color.slot));
#endif
}

SpringEnd endAt(uint i) {
  return SpringEnd(texelFetch(positionsSoFar, int(i)), texelFetch(velocitiesSoFar, int(i)).xyz, false);
}

void store(uint i, SpringEnd end) {
  if (!end.moved) return;
  newPositions[i] = end.position;
  newVelocities[i] = vec4(end.velocity, 0.0);
}

void main() {
  LimitedSpring spring = thisSpring();
  if (!spring.exists) return;
  SpringEnd a = endAt(spring.a), b = endAt(spring.b);
  limitSpring(a, b, spring.limit);
  store(spring.a, a);
  store(spring.b, b);
}
