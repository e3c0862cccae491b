// The pairs of parts that may touch, as the passes of the implicit step see them; the twin is in
// src/solver/cpu/implicit_contact.h. Needs sim/implicit/contact.glsl.
#include "shared/surface.h"

layout(binding = PAIR_IDS_UNIT) uniform usamplerBuffer pairIds;
layout(binding = PAIR_ROWS_UNIT) uniform samplerBuffer pairRows;

#if HAS_SMALL_COLLIDERS
layout(binding = PAIR_CARRIES_UNIT) uniform samplerBuffer pairCarries;
// A displacement of a pair, relative to the small collider that it may be with.
vec3 relativeToPair(uint q, vec3 d) {
  precise vec3 relative = d - texelFetch(pairCarries, int(q)).xyz;
  return relative;
}
#else
vec3 relativeToPair(uint q, vec3 d) { return d; }
#endif

vec4 pairRow(uint q, uint row) { return texelFetch(pairRows, int(4u * q + row)); }

vec3 weightedSum(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
  precise vec3 sum = ((weights.x * a + weights.y * b) + weights.z * c) + weights.w * d;
  return sum;
}
