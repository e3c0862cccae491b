// The list of each particle in ascending order.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(binding = PAIR_STARTS_UNIT) uniform usamplerBuffer pairStarts;
layout(binding = PAIR_BLOCKS_UNIT) uniform usamplerBuffer pairBlocks;
layout(std430, binding = SURFACE_OUT_BINDING) readonly buffer Cursors { uint cursors[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) buffer Entries { uint entries[]; };

void main() {
  uint i = thisEntry();
  if (i >= step.totalParticles || state.pairs == 0u || isSettled()) return;
  uint first = texelFetch(pairStarts, int(i)).x + texelFetch(pairBlocks, int(i / SURFACE_BLOCK)).x;
  uint end = first + cursors[i];
  for (uint k = first + 1u; k < end; ++k) {
    uint entry = entries[k], place = k;
    for (; place > first && entries[place - 1u] > entry; --place) entries[place] = entries[place - 1u];
    entries[place] = entry;
  }
}
