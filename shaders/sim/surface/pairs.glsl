// The pairs of parts that may touch, as the passes of the implicit step see them; the twin is in
// src/solver/cpu/implicit_contact.h. Needs sim/implicit/contact.glsl.
#include "shared/surface.h"

layout(binding = PAIR_IDS_UNIT) uniform usamplerBuffer pairIds;
layout(binding = PAIR_ROWS_UNIT) uniform samplerBuffer pairRows;
layout(binding = PAIR_STARTS_UNIT) uniform usamplerBuffer pairStarts;
layout(binding = PAIR_BLOCKS_UNIT) uniform usamplerBuffer pairBlocks;
layout(binding = PAIR_ENTRIES_UNIT) uniform usamplerBuffer pairEntries;

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

// Of a particle: entries [x, y).
uint firstPairOf(uint i) { return texelFetch(pairStarts, int(i)).x + texelFetch(pairBlocks, int(i / SURFACE_BLOCK)).x; }
uvec2 pairsOf(uint i) {
  if (scalars.pairs == 0u) return uvec2(0u);
  uint end = i + 1u < step.totalParticles ? firstPairOf(i + 1u) : 4u * scalars.pairs;
  return uvec2(firstPairOf(i), end);
}
uint pairEntry(uint k) { return texelFetch(pairEntries, int(k)).x; }

// Whether some pair of a particle is not with a small collider.
bool mayTouchCloth(uint i) {
  uvec2 range = pairsOf(i);
  for (uint k = range.x; k < range.y; ++k)
    if (!(pairRow(pairEntry(k) / 4u, 2u).y < 0.0)) return true;
  return false;
}

vec3 weightedSum(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
  precise vec3 sum = ((weights.x * a + weights.y * b) + weights.z * c) + weights.w * d;
  return sum;
}
