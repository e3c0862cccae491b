// Blocks of grids, and what their sides are.
layout(binding = FLAT_BLOCKS_UNIT) uniform usamplerBuffer flatBlocks;
layout(binding = ITERATES_UNIT) uniform samplerBuffer iterates;

struct Block {
  uint first, stride;
  uvec2 size, place, places;
  uint firstOfGrid;
  float perAlong, perDown, apart;
};
Block blockAt(uint number) {
  uvec4 a = texelFetch(flatBlocks, int(3u * number)), b = texelFetch(flatBlocks, int(3u * number + 1u)),
        c = texelFetch(flatBlocks, int(3u * number + 2u));
  return Block(a.x, a.y, a.zw, b.xy, b.zw, c.x, uintBitsToFloat(c.y), uintBitsToFloat(c.z), uintBitsToFloat(c.w));
}

struct BlockSides {
  Bounds along, down;
};
BlockSides noSides() {
  Bounds nothing = Bounds(vec3(LARGE_SQUARE), vec3(-LARGE_SQUARE));
  return BlockSides(nothing, nothing);
}
BlockSides joinedSides(BlockSides a, BlockSides b) { return BlockSides(joined(a.along, b.along), joined(a.down, b.down)); }

// Whether parts that have no particle in common stay farther apart than what matters in this search.
bool isFlatEnough(Block block, BlockSides sides) {
  float stretch = leastStretch(sides.along.low, sides.along.high, sides.down.low, sides.down.high);
  precise float room = stretch * block.apart;
  precise float gaps = LEAST_GAPS_OF_FLAT * surface.leastGap;
  float reach = SEARCHES_TOUCHING != 0 ? surface.touchingReach : gaps;
  return reach < room;
}

// Where the motion of this round ends, or is predicted to end.
vec3 endAt(uint i) {
#if SEARCHES_TOUCHING
  return isLater() ? startAt(i) : texelFetch(iterates, int(i)).xyz;
#else
  return texelFetch(positionsSoFar, int(i)).xyz;
#endif
}
