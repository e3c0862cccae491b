// At the end of a step: how far triangles have to go that are still deep in small colliders. STOPS_SLIPS: so that they do not
// creep. ONLY_COUNTS: which of them the cores of such colliders have passed.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/surface/meeting.glsl"

layout(std430, binding = SURFACE_STATE_BINDING) coherent buffer State { SurfaceState state; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };

// What LEFT_INSIDE is a part of.
float leastSize(SmallCollider small) {
  precise float reach = small.near - small.radius;
  return small.radius < reach ? small.radius : reach;
}

#if STOPS_SLIPS
layout(binding = PAIR_SLIPS_UNIT) uniform usamplerBuffer pairSlips;
vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

// What the solution leaves of Coulomb's friction [N], in w, and the slip of the step.
vec4 slipOfPair(uint q, uvec4 ids, float limit) {
  vec3 dA = displacementAt(ids.x), normal = pairRow(q, 0u).xyz;
  vec3 relative = relativeToPair(q, weightedSum(pairRow(q, 1u), dA, displacementAt(ids.y), displacementAt(ids.z), dA));
  precise vec3 slip = relative - sumOfProducts(normal, relative) * normal;
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float used = frictionSlope(len, inverse, slowSlip()).over * len;
  precise float rest = 1.0 - used;
  precise float left = limit * (rest < 0.0 ? 0.0 : rest);
  vec3 elastic = uintBitsToFloat(texelFetch(pairSlips, int(2u * q)).xyz);
  precise vec3 own = slip - (elastic - sumOfProducts(normal, elastic) * normal);
  return vec4(canonical(own), canonical(left));
}
#else
Met meetAtEnd(SmallCollider small, uvec4 ids) {
  ColliderParams collider = loadCollider(step.firstCollider + uint(small.number));
  vec3 start[3], end[3];
  for (int k = 0; k < 3; ++k) {
    start[k] = texelFetch(starts, int(ids[k])).xyz;
    end[k] = texelFetch(positionsSoFar, int(ids[k])).xyz;
  }
  return meet(small, collider, start, end, false, vec3(0.0));
}
#endif

#if !ONLY_COUNTS && !STOPS_SLIPS
float mobilityOf(vec3 weights, uvec4 ids) {
  precise float mobility = 0.0;
  for (int k = 0; k < 3; ++k)
    mobility = mobility + (weights[k] * weights[k]) * texelFetch(starts, int(ids[k])).w;
  return mobility;
}
#endif

void main() {
  uint q = thisPair();
  if (q >= scalars.pairs) return;
#if !ONLY_COUNTS
  if (state.isSettled != 0u) return;
#endif
  vec4 law = pairRow(q, 2u);
  if (!(law.y < 0.0)) return;
  uvec4 ids = texelFetch(pairIds, int(q));
#if STOPS_SLIPS
  vec4 wanted = slipOfPair(q, ids, law.z);
  bool wants = 0.0 < wanted.w;
#else
  SmallCollider small = smallColliderAt(uint(-law.y) - 1u);
  Met met = meetAtEnd(small, ids);
#endif
#if ONLY_COUNTS
  if (!met.passes || !(LEFT_INSIDE * leastSize(small) < met.touch.depth)) return;
  atomicAdd(state.passages, 1u);
  if ((atomicOr(state.isPressed, 2u) & 2u) == 0u) atomicAdd(state.passageSteps, 1u);
#else
#if !STOPS_SLIPS
  float mobility = mobilityOf(met.weights, ids);
  precise float left = LEFT_INSIDE * leastSize(small);
  precise float push = met.touch.depth - 0.5 * left;
  precise vec3 way = push * met.touch.normal;
  bool wants = met.counts && left < met.touch.depth && 0.0 < mobility;
  vec4 wanted = wants ? vec4(canonical(way), reciprocal(mobility)) : vec4(0.0);
  newRows[4u * q + 1u] = vec4(met.weights, 0.0);
#endif
  newRows[4u * q + 3u] = wanted;
  if (wants) atomicOr(state.isPressed, 1u);
#endif
}
