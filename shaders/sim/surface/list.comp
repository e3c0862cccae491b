// Puts pairs into the lists of their particles, in any order.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(binding = PAIR_IDS_UNIT) uniform usamplerBuffer pairIds;
layout(binding = PAIR_STARTS_UNIT) uniform usamplerBuffer pairStarts;
layout(binding = PAIR_BLOCKS_UNIT) uniform usamplerBuffer pairBlocks;
layout(std430, binding = SURFACE_OUT_BINDING) coherent buffer Cursors { uint cursors[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) writeonly buffer Entries { uint entries[]; };

void main() {
  uint q = thisEntry();
  if (q >= state.pairs || isSettled()) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  for (int k = 0; k < 4; ++k) {
    uint i = ids[k];
    uint first = texelFetch(pairStarts, int(i)).x + texelFetch(pairBlocks, int(i / SURFACE_BLOCK)).x;
    entries[first + atomicAdd(cursors[i], 1u)] = 4u * q + uint(k);
  }
}
