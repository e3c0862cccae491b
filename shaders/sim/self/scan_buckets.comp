// Building the hash, 2: exclusive prefix sums within blocks of buckets, a work group each; then the last group has those of
// the blocks' totals. The counts are zero again for the next time.
#include "sim/self/particles.glsl"
#include "sim/last_group.glsl"
#define SCAN_LANES HASH_GROUP
#include "sim/scan_lanes.glsl"

layout(std430, binding = BUCKET_COUNTS_BINDING) buffer Counts { uint counts[]; };
layout(std430, binding = BUCKETS_BINDING) writeonly buffer Buckets { uint starts[]; };
layout(std430, binding = BUCKET_BLOCKS_BINDING) coherent buffer Blocks { uint blockTotals[]; };

void scanBlock(uint lane) {
  const uint each = BUCKETS_A_BLOCK / uint(HASH_GROUP);
  uint first = gl_WorkGroupID.x * BUCKETS_A_BLOCK + lane * each;
  uint end = min(first + each, self.bucketMask + 1u);
  uint total = 0u;
  for (uint bucket = first; bucket < end; ++bucket) total += counts[bucket];
  uint through = scanLanes(lane, total);
  uint start = through - total;
  for (uint bucket = first; bucket < end; ++bucket) {
    starts[bucket] = start;
    start += counts[bucket];
    counts[bucket] = 0u;
  }
  if (lane == uint(HASH_GROUP) - 1u) blockTotals[gl_WorkGroupID.x] = through;
}

void scanTotals(uint lane) {
  uint each = (self.bucketBlocks + uint(HASH_GROUP) - 1u) / uint(HASH_GROUP);
  uint first = lane * each, end = min(first + each, self.bucketBlocks);
  uint total = 0u;
  for (uint block = first; block < end; ++block) total += blockTotals[block];
  uint start = scanLanes(lane, total) - total;
  for (uint block = first; block < end; ++block) {
    uint own = blockTotals[block];
    blockTotals[block] = start;
    start += own;
  }
}

void main() {
  scanBlock(gl_LocalInvocationID.x);
  if (isLastGroupOf(self.bucketBlocks)) scanTotals(gl_LocalInvocationID.x);
}
