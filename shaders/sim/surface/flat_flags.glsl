// Which blocks are flat together with those around them, and, by the first work group, whether the only grid is as a whole.
#include "sim/surface/blocks.glsl"

layout(binding = FLAT_SIDES_UNIT) uniform samplerBuffer flatSides;
layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Flags { uint newFlags[]; };

shared BlockSides lanes[SURFACE_LANES];

BlockSides sidesAt(uint number) {
  int first = int(4u * number);
  return BlockSides(Bounds(texelFetch(flatSides, first).xyz, texelFetch(flatSides, first + 1).xyz),
                    Bounds(texelFetch(flatSides, first + 2).xyz, texelFetch(flatSides, first + 3).xyz));
}

// By all invocations of a work group, one of those for blocks.
void findFlags(uint group) {
  uint lane = gl_LocalInvocationIndex, number = group * uint(SURFACE_LANES) + lane;
  if (number < surface.blocks) {
    Block block = blockAt(number);
    BlockSides around = sidesAt(number);
    uvec2 begin = uvec2(block.place.x == 0u ? 0u : block.place.x - 1u, block.place.y == 0u ? 0u : block.place.y - 1u);
    for (uint row = begin.y; row < block.place.y + 2u && row < block.places.y; ++row)
      for (uint column = begin.x; column < block.place.x + 2u && column < block.places.x; ++column)
        around = joinedSides(around, sidesAt(block.firstOfGrid + row * block.places.x + column));
    newFlags[number] = isFlatEnough(block, around) ? 1u : 0u;
  }
  if (group != 0u || surface.isOneGrid == 0u) return;
  BlockSides own = noSides();
  for (uint k = lane; k < surface.blocks; k += uint(SURFACE_LANES)) own = joinedSides(own, sidesAt(k));
  lanes[lane] = own;
  barrier();
  if (lane != 0u) return;
  for (int k = 1; k < SURFACE_LANES; ++k) own = joinedSides(own, lanes[k]);
  state.isFlat = isFlatEnough(blockAt(0u), own) ? 1u : 0u;
}
