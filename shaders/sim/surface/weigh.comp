// How the pairs press at the displacements so far: forces, and what they add to the Hessian.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/surface/pairs.glsl"

layout(binding = PAIR_SLIPS_UNIT) uniform usamplerBuffer pairSlips;
layout(binding = SURFACE_POINTS_UNIT) uniform samplerBuffer points;
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };

vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

float frictionOf(uvec4 ids, vec4 weights) {
  precise float friction = 0.0;
  for (int k = 0; k < 4; ++k) {
    float w = weights[k], size = w < 0.0 ? -w : w;
    friction = friction + size * texelFetch(points, int(ids[k])).y;
  }
  precise float mean = 0.5 * friction;
  return mean;
}

void main() {
  uint q = thisPair();
  if (isSkipped() || q >= scalars.pairs) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  vec4 normal = pairRow(q, 0u), weights = pairRow(q, 1u), law = pairRow(q, 2u);
  vec3 moved = weightedSum(weights, displacementAt(ids.x), displacementAt(ids.y), displacementAt(ids.z), displacementAt(ids.w));
  float along = sumOfProducts(normal.xyz, moved);
  precise float over = normal.w - along;
  vec3 relative = relativeToPair(q, moved);
  precise vec3 slip = relative - sumOfProducts(normal.xyz, relative) * normal.xyz;
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  bool isOfCollider = law.y < 0.0;  // which has limited its friction already (meet.comp)
  // Where cloth is predicted to come it presses a hundred times too much, so that the first Newton step knows friction only of what
  // held when the last step ended. Then the less of this and the last Newton step: what is not solved yet presses at random, and
  // would stick.
  precise float press = law.x * (over < 0.0 ? 0.0 : over);
  precise float most = frictionOf(ids, weights) * (press < law.y ? press : law.y);
  bool isNew = !(law.y < LARGE_SQUARE), isLimited = isOfCollider || !(isNew || frictionFollows());
  float before = uintBitsToFloat(texelFetch(pairSlips, int(2u * q + 1u)).x);
  bool isFirst = !isOfCollider && scalars.newtonSteps == 0u, wasHeld = isFirst && before > 0.0;
  float limit = isFirst ? limitOf(before) : isLimited ? law.z : canonical(most);
  precise float across = limit * frictionSlope(len, inverse, slowSlip()).over;
  float held = isOfCollider ? law.w : wasHeld || over > 0.0 ? law.x : 0.0;
  precise vec3 force = (held * over) * normal.xyz - across * slip;
  newRows[4u * q + 2u] = vec4(law.x, isOfCollider ? law.y : canonical(press), limit, held);
  newRows[4u * q + 3u] = vec4(canonical(force), canonical(across));
}
