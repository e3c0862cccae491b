// The tree of boxes from its third level on, and which blocks are flat. A work group joins SURFACE_LANES boxes of that level into
// one of the highest level that it can reach; the last group to finish takes all levels above. The other groups take blocks.
#include "sim/surface/common.glsl"
#include "sim/surface/flat_flags.glsl"
#define GROUPS_DONE state.groupsDone
#include "sim/last_group.glsl"

layout(local_size_x = SURFACE_LANES) in;
layout(std430, binding = SURFACE_OUT_BINDING) coherent buffer Boxes { vec4 newBoxes[]; };

MovingBounds newBoxAt(uint i) { return boundsOf(newBoxes[3u * i], newBoxes[3u * i + 1u], newBoxes[3u * i + 2u]); }

uint countOf(int level) { return surface.firstBoxes[level + 1].x - surface.firstBoxes[level].x; }

void join(int level, uint k) {
  uint box = surface.firstBoxes[level].x + k, child = surface.firstBoxes[level - 1].x + BOX_CHILDREN * k;
  uint end = child + BOX_CHILDREN < surface.firstBoxes[level].x ? child + BOX_CHILDREN : surface.firstBoxes[level].x;
  MovingBounds bounds = newBoxAt(child);
  for (uint other = child + 1u; other < end; ++other) bounds = joined(bounds, newBoxAt(other));
  vec4 rows[3] = rowsOf(bounds);
  for (uint k = 0u; k < 3u; ++k) newBoxes[3u * box + k] = rows[k];
}

void main() {
  if (isSettled()) return;
#if ONLY_BOXES
  if (state.tooNear[0] == 0u) return;
#endif
  uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;
  int level = 2;
  uint groups = surface.topLevel < level ? 0u : (countOf(level) + uint(SURFACE_LANES) - 1u) / uint(SURFACE_LANES);
  if (group >= groups) {
    findFlags(group - groups);
    return;
  }
  for (uint width = uint(SURFACE_LANES); width > 0u && level <= surface.topLevel; width /= BOX_CHILDREN, ++level) {
    uint k = group * width + lane;
    if (lane < width && k < countOf(level)) join(level, k);
    awaitGroup();
  }
  if (level > surface.topLevel || !isLastGroupOf(groups)) return;
  for (; level <= surface.topLevel; ++level) {
    for (uint k = lane; k < countOf(level); k += uint(SURFACE_LANES)) join(level, k);
    awaitGroup();
  }
}
