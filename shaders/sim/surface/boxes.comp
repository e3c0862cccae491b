// A level of the tree from the one below; the last levels, which have few boxes, all in one work group.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_LANES) in;
layout(std140, binding = BOX_LEVEL_BINDING) uniform LevelBlock { BoxLevel level; };
layout(std430, binding = SURFACE_OUT_BINDING) coherent buffer Boxes { vec4 newBoxes[]; };

Bounds newBoxAt(uint i) { return Bounds(newBoxes[2u * i].xyz, newBoxes[2u * i + 1u].xyz); }

void main() {
  if (isSettled()) return;
  uint below = level.below, first = level.first, count = level.count;
  for (;;) {
    uint begin = gl_GlobalInvocationID.x, stride = gl_NumWorkGroups.x * uint(SURFACE_LANES);
    for (uint k = begin; k < count; k += stride) {
      uint child = below + BOX_CHILDREN * k, end = child + BOX_CHILDREN < first ? child + BOX_CHILDREN : first;
      Bounds box = newBoxAt(child);
      for (uint other = child + 1u; other < end; ++other) box = joined(box, newBoxAt(other));
      newBoxes[2u * (first + k)] = vec4(box.low, 0.0);
      newBoxes[2u * (first + k) + 1u] = vec4(box.high, 0.0);
    }
    if (level.isLast == 0u || count == 1u) return;
    memoryBarrierBuffer();
    barrier();
    below = first;
    first += count;
    count = (count + BOX_CHILDREN - 1u) / BOX_CHILDREN;
  }
}
