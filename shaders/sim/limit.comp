// Pass 5: no spring longer than the strain limit allows. One dispatch a colour; springs of a colour share no particle, so
// each works in place. Both ends move half of the excess towards each other, or the free end all of it.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"

layout(std140, binding = LIMIT_COLOR_BINDING) uniform ColorBlock { LimitColor color; };

const ivec2 toOtherEnd[6] =
    ivec2[6](ivec2(-1, 0), ivec2(0, -1), ivec2(-1, -1), ivec2(1, -1), ivec2(-2, 0), ivec2(0, -2));

void move(uint i, vec4 x, vec3 by) {
  precise vec3 newX = x.xyz + by;
  precise vec3 newV = texelFetch(velocitiesSoFar, int(i)).xyz + step.inverseTimeStep * by;
  newPositions[i] = vec4(canonical(newX), x.w);
  newVelocities[i] = vec4(canonical(newV), 0.0);
}

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

  precise float limit = step.springs[color.slot].limitLength;
  if (hasRestLengthTable)
    limit = step.limitFactor * texelFetch(restLengths, int(color.slot * step.totalParticles + a)).x;
  return LimitedSpring(a, b, limit, isIntact(cutMaskOf(a), color.slot));
#endif
}

void main() {
  LimitedSpring spring = thisSpring();
  if (!spring.exists) return;
  uint a = spring.a, b = spring.b;
  vec4 xa = texelFetch(positionsSoFar, int(a)), xb = texelFetch(positionsSoFar, int(b));
  precise float limit = spring.limit;
  precise vec3 d = xb.xyz - xa.xyz;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float limitSquared = limit * limit;
  bool freeA = xa.w > 0.0, freeB = xb.w > 0.0;
  if (!(limitSquared < lengthSquared) || !(freeA || freeB)) return;
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float len = lengthSquared * inverseLength;
  precise float excess = (len - limit) * inverseLength;
  precise float share = freeA && freeB ? 0.5 * excess : excess;
  precise vec3 by = share * d;
  if (freeA) move(a, xa, by);
  if (freeB) move(b, xb, -by);
}
