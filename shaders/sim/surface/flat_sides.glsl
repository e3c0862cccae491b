// Of each block of a grid: the boxes of its sides along rows, and along columns, over their distance in the grid, at the start and
// at the end of the motion; the twin is src/solver/cpu/flat_blocks.h.
#include "sim/surface/blocks.glsl"

layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Sides { vec4 newSides[]; };

vec3 placeOf(uint i, int end) { return end == 0 ? startAt(i) : endAt(i); }

void findSides(uint number) {
  Block block = blockAt(number);
  BlockSides sides = noSides();
  for (int end = 0; end < 2; ++end)
    for (uint row = 0u; row < block.size.y; ++row)
      for (uint column = 0u; column < block.size.x; ++column) {
        uint i = block.first + row * block.stride + column;
        vec3 place = placeOf(i, end);
        if (column + 1u < block.size.x) {
          precise vec3 side = block.perAlong * (placeOf(i + 1u, end) - place);
          sides.along = joined(sides.along, Bounds(side, side));
        }
        if (row + 1u < block.size.y) {
          precise vec3 side = block.perDown * (placeOf(i + block.stride, end) - place);
          sides.down = joined(sides.down, Bounds(side, side));
        }
      }
  newSides[4u * number] = vec4(sides.along.low, 0.0);
  newSides[4u * number + 1u] = vec4(sides.along.high, 0.0);
  newSides[4u * number + 2u] = vec4(sides.down.low, 0.0);
  newSides[4u * number + 3u] = vec4(sides.down.high, 0.0);
}
