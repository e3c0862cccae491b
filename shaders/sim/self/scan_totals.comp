// Building the hash, 4: exclusive prefix sums of the blocks' totals, in one work group.
#include "sim/self/particles.glsl"
#include "sim/self/scan.glsl"

layout(std430, binding = HASHED_BINDING) buffer Blocks { uint blockTotals[]; };

void main() {
  uint each = (self.bucketBlocks + uint(HASH_GROUP) - 1u) / uint(HASH_GROUP);
  uint lane = gl_LocalInvocationID.x;
  uint first = lane * each;
  uint total = 0u;
  for (uint k = 0u; k < each; ++k)
    if (first + k < self.bucketBlocks) total += blockTotals[first + k];
  uint through = scanLanes(lane, total);
  uint start = through - total;
  for (uint k = 0u; k < each; ++k) {
    if (first + k >= self.bucketBlocks) break;
    uint count = blockTotals[first + k];
    blockTotals[first + k] = start;
    start += count;
  }
}
