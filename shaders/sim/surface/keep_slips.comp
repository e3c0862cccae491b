// What friction of the pairs remembers when a step ends; the twin is in src/solver/cpu/surface_pairs.cpp.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/surface/pairs.glsl"

layout(binding = PAIR_SLIPS_UNIT) uniform usamplerBuffer pairSlips;
layout(std430, binding = SURFACE_STATE_BINDING) readonly buffer State { SurfaceState state; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Slips { uvec4 newSlips[]; };

vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

void main() {
  uint q = thisPair();
  if (q >= scalars.pairs || state.isSettled != 0u) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  vec3 normal = pairRow(q, 0u).xyz;
  vec3 moved = weightedSum(pairRow(q, 1u), displacementAt(ids.x), displacementAt(ids.y), displacementAt(ids.z), displacementAt(ids.w));
  vec3 relative = relativeToPair(q, moved);
  precise vec3 slip = relative - sumOfProducts(normal, relative) * normal;
  precise float part = slowSlip() * inverseSquareRoot(sumOfProducts(slip, slip));
  precise vec3 elastic = (part < 1.0 ? part : 1.0) * slip;
  vec4 law = pairRow(q, 2u);
  vec3 kept = law.z > 0.0 ? canonical(elastic) : vec3(0.0);
  newSlips[2u * q] = uvec4(floatBitsToUint(kept), texelFetch(pairSlips, int(2u * q)).w);
  newSlips[2u * q + 1u] = uvec4(floatBitsToUint(heldLimit(law.w > 0.0, law.z)), uvec3(0u));
}
