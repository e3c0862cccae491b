// The pairs of parts that may touch, as the passes of the implicit step see them; the twin is in
// src/solver/cpu/implicit_contact.h. Needs sim/implicit/contact.glsl.
#include "shared/surface.h"

layout(binding = PAIR_IDS_UNIT) uniform usamplerBuffer pairIds;
layout(binding = PAIR_ROWS_UNIT) uniform samplerBuffer pairRows;

layout(binding = PAIR_CARRIES_UNIT) uniform samplerBuffer pairCarries;

uint thisPair() { return (gl_WorkGroupID.y * GROUPS_A_ROW + gl_WorkGroupID.x) * uint(SURFACE_GROUP) + gl_LocalInvocationIndex; }

// What friction acts on of a displacement of a pair.
vec3 relativeToPair(uint q, vec3 d) {
  precise vec3 relative = d - texelFetch(pairCarries, int(q)).xyz;
  return relative;
}

vec4 pairRow(uint q, uint row) { return texelFetch(pairRows, int(4u * q + row)); }

vec3 weightedSum(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
  precise vec3 sum = ((weights.x * a + weights.y * b) + weights.z * c) + weights.w * d;
  return sum;
}
