// Exclusive prefix sums of the blocks' totals, in one work group; and what comes of the number of pairs.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/surface/common.glsl"
#include "sim/surface/scan.glsl"

layout(local_size_x = SURFACE_LANES) in;
layout(std430, binding = SURFACE_OUT_BINDING) buffer Blocks { uint blockTotals[]; };
layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Dispatches { uvec4 dispatches[]; };

void main() {
  if (isSettled()) return;
  uint size = SCANS_LISTS != 0 ? step.totalParticles : surface.triangles;
  uint blocks = (size + SURFACE_BLOCK - 1u) / SURFACE_BLOCK;
  uint each = (blocks + uint(SURFACE_LANES) - 1u) / uint(SURFACE_LANES);
  uint lane = gl_LocalInvocationIndex, first = lane * each;
  uint total = 0u;
  for (uint k = 0u; k < each; ++k)
    if (first + k < blocks) total += blockTotals[first + k];
  uint through = scanLanes(lane, total), start = through - total;
  for (uint k = 0u; k < each; ++k) {
    if (first + k >= blocks) break;
    uint count = blockTotals[first + k];
    blockTotals[first + k] = start;
    start += count;
  }
#if !SCANS_LISTS
  if (lane != uint(SURFACE_LANES) - 1u) return;
  state.mostPairs = state.mostPairs < through ? through : state.mostPairs;
  if (through > surface.roomForPairs && state.tooMany == 0u) state.tooMany = 1u;
  uint count = state.tooMany != 0u ? 0u : through, groups = (count + uint(SURFACE_GROUP) - 1u) / uint(SURFACE_GROUP);
  uvec4 dispatch = uvec4(groups < GROUPS_A_ROW ? groups : GROUPS_A_ROW, (groups + GROUPS_A_ROW - 1u) / GROUPS_A_ROW, 1u, 0u);
  if (surface.touchesItself == 0u && state.tooMany == 1u) state.crowdedSteps += 1u;
  state.pairs = count;
  scalars.pairs = count;
  dispatches[0] = dispatch;
#endif
}
