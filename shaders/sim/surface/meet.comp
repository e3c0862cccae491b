// What the pairs of triangles and small colliders are at the iterate.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/surface/meeting.glsl"

layout(binding = PAIR_SLIPS_UNIT) uniform usamplerBuffer pairSlips;
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };
layout(std430, binding = SURFACE_CARRIES_BINDING) writeonly buffer Carries { vec4 newCarries[]; };

vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

void main() {
  uint q = thisPair();
  if (isSkipped() || q >= scalars.pairs) return;
  vec4 law = pairRow(q, 2u);
  if (!(law.y < 0.0)) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  vec4 old = pairRow(q, 0u);
  vec3 dA = displacementAt(ids.x), dB = displacementAt(ids.y), dC = displacementAt(ids.z);
  // What still presses as it was is held as it is now: that it has slid a hair off decides nothing.
  vec3 movedThen = weightedSum(pairRow(q, 1u), dA, dB, dC, dA);
  precise float before = old.w - sumOfProducts(old.xyz, movedThen);
  bool pressed = law.w > 0.0 && before > 0.0;
  SmallCollider small = smallColliderAt(uint(-law.y) - 1u);
  ColliderParams collider = loadCollider(step.firstCollider + uint(small.number));
  vec3 start[3], end[3];
  for (int k = 0; k < 3; ++k) {
    start[k] = texelFetch(starts, int(ids[k])).xyz;
    end[k] = iterateAt(ids[k]).xyz;
  }
  bool isNew = !(law.z < LARGE_SQUARE), follows = isNew || frictionFollows();
  Met met = meet(small, collider, start, end, !follows, pairRow(q, 1u).xyz);
  precise float inertia = 0.0;
  precise float springs = 0.0;
  precise float squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    precise float square = met.weights[k] * met.weights[k];
    inertia = inertia + square * texelFetch(rightHandSides, int(ids[k])).w;
    springs = springs + square * texelFetch(points, int(ids[k])).w;
    squares = squares + square;
  }
  float inverse = reciprocal(squares);
  precise float ofInertia = inertia * inverse;
  precise float mostSprings = MOST_OVER_INERTIA * ofInertia;
  precise float ofSprings = springs * inverse;
  precise float stiffness = float(CONTACT_OVER_INERTIA) * ofInertia + (ofSprings < mostSprings ? ofSprings : mostSprings);
  float depth = met.touch.depth;
  bool holds = met.counts && (depth > 0.0 || pressed);
  float friction = hasCoulombFriction ? collider.friction : 0.0;
  vec3 normal = canonical(met.touch.normal);
  vec4 weights = vec4(met.weights, 0.0);
  precise float over = depth + sumOfProducts(normal, weightedSum(weights, dA, dB, dC, dA));
  precise float most = friction * (stiffness * (depth < 0.0 ? 0.0 : depth));
  float limit = follows ? canonical(holds ? most : 0.0) : law.z;
  newRows[4u * q] = vec4(normal, canonical(over));
  newRows[4u * q + 1u] = weights;
  newRows[4u * q + 2u] =
      vec4(met.counts ? stiffness : 0.0, law.y, limit, holds ? stiffness : 0.0);
  precise vec3 carry = canonical(met.touch.carry) - uintBitsToFloat(texelFetch(pairSlips, int(2u * q)).xyz);
  newCarries[q] = vec4(carry, 0.0);
  if (holds) atomicOr(scalars.isDisturbed, 1u);
}
