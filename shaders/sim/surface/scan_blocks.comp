// Exclusive prefix sums of counts within blocks, a work group each, and the blocks' totals.
#include "sim/surface/common.glsl"
#include "sim/surface/scan.glsl"

layout(local_size_x = SURFACE_LANES) in;
layout(std430, binding = SURFACE_COUNTS_BINDING) buffer Counts { uint counts[]; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Blocks { uint blockTotals[]; };

void main() {
  if (isSettled()) return;
  const uint each = SURFACE_BLOCK / uint(SURFACE_LANES);
  uint size = SCANS_LISTS != 0 ? step.totalParticles : surface.triangles;
  uint lane = gl_LocalInvocationIndex, first = gl_WorkGroupID.x * SURFACE_BLOCK + lane * each;
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
  if (lane == uint(SURFACE_LANES) - 1u) blockTotals[gl_WorkGroupID.x] = through;
}
