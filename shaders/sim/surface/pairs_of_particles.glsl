// The pairs of parts that may touch, as a particle sees them. Needs sim/implicit/contact.glsl.
#include "sim/surface/pairs.glsl"

layout(binding = PAIR_STARTS_UNIT) uniform usamplerBuffer pairStarts;
layout(binding = PAIR_BLOCKS_UNIT) uniform usamplerBuffer pairBlocks;
layout(binding = PAIR_ENTRIES_UNIT) uniform usamplerBuffer pairEntries;

// Of a particle: entries [x, y).
uint firstPairOf(uint i) { return texelFetch(pairStarts, int(i)).x + texelFetch(pairBlocks, int(i / SURFACE_BLOCK)).x; }
uvec2 pairsOf(uint i) {
  if (scalars.pairs == 0u) return uvec2(0u);
  uint end = i + 1u < step.totalParticles ? firstPairOf(i + 1u) : 4u * scalars.pairs;
  return uvec2(firstPairOf(i), end);
}
uint pairEntry(uint k) { return texelFetch(pairEntries, int(k)).x; }
