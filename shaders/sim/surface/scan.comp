// Exclusive prefix sums of counts: within blocks, a work group each, and, by the last group to finish, of the blocks' totals; and
// what comes of the number of pairs.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/surface/common.glsl"
#include "sim/last_group.glsl"

layout(local_size_x = SURFACE_LANES) in;
layout(std430, binding = SURFACE_COUNTS_BINDING) buffer Counts { uint counts[]; };
layout(std430, binding = SURFACE_OUT_BINDING) coherent buffer Blocks { uint blockTotals[]; };
layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Dispatches { uvec4 dispatches[]; };

#define SCAN_LANES SURFACE_LANES
#include "sim/scan_lanes.glsl"

// The total of the block up to and with this lane.
uint scanBlock(uint lane, uint size) {
  const uint each = SURFACE_BLOCK / uint(SURFACE_LANES);
  uint first = gl_WorkGroupID.x * SURFACE_BLOCK + lane * each;
  uint total = 0u;
  for (uint k = 0u; k < each; ++k)
    if (first + k < size) total += counts[first + k];
  uint through = scanLanes(lane, total), start = through - total;
  for (uint k = 0u; k < each; ++k) {
    if (first + k >= size) break;
    uint count = counts[first + k];
    counts[first + k] = start;
    start += count;
  }
  return through;
}

// The total of all blocks up to and with those of this lane.
uint scanTotals(uint lane, uint blocks) {
  uint each = (blocks + uint(SURFACE_LANES) - 1u) / uint(SURFACE_LANES), first = lane * each;
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
  return through;
}

void takeTotal(uint pairs) {
  state.mostPairs = state.mostPairs < pairs ? pairs : state.mostPairs;
  if (pairs > surface.roomForPairs && state.tooMany == 0u) state.tooMany = 1u;
  uint count = state.tooMany != 0u ? 0u : pairs, groups = (count + uint(SURFACE_GROUP) - 1u) / uint(SURFACE_GROUP);
  uvec4 dispatch = uvec4(groups < GROUPS_A_ROW ? groups : GROUPS_A_ROW, (groups + GROUPS_A_ROW - 1u) / GROUPS_A_ROW, 1u, 0u);
  if (surface.touchesItself == 0u && state.tooMany == 1u) state.crowdedSteps += 1u;
  state.pairs = count;
  scalars.pairs = count;
  dispatches[0] = dispatch;
}

void main() {
  if (isSettled()) return;
  uint lane = gl_LocalInvocationIndex, last = uint(SURFACE_LANES) - 1u;
  uint total = scanBlock(lane, SCANS_LISTS != 0 ? step.totalParticles : surface.triangles);
  if (lane == last) blockTotals[gl_WorkGroupID.x] = total;
  if (!isLastGroupOf(gl_NumWorkGroups.x)) return;
  uint all = scanTotals(lane, gl_NumWorkGroups.x);
  if (SCANS_LISTS == 0 && lane == last) takeTotal(all);
}
