// Building the hash, 3: exclusive prefix sums within blocks of buckets, a work group each, and the blocks' totals.
#include "sim/self/particles.glsl"
#include "sim/self/scan.glsl"

layout(std430, binding = BUCKETS_BINDING) buffer Buckets { uint buckets[]; };
layout(std430, binding = HASHED_BINDING) writeonly buffer Blocks { uint blockTotals[]; };

void main() {
  const uint each = BUCKETS_A_BLOCK / uint(HASH_GROUP);
  uint lane = gl_LocalInvocationID.x;
  uint first = gl_WorkGroupID.x * BUCKETS_A_BLOCK + lane * each;
  uint total = 0u;
  for (uint k = 0u; k < each; ++k)
    if (first + k <= self.bucketMask) total += buckets[first + k];
  uint through = scanLanes(lane, total);
  uint start = through - total;
  for (uint k = 0u; k < each; ++k) {
    if (first + k > self.bucketMask) break;
    uint count = buckets[first + k];
    buckets[first + k] = start;
    start += count;
  }
  if (lane == uint(HASH_GROUP) - 1u) blockTotals[gl_WorkGroupID.x] = through;
}
