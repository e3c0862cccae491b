// Building the hash, 4: exclusive prefix sums of the blocks' totals, in one work group.
#include "sim/self/particles.glsl"

layout(std430, binding = HASHED_BINDING) buffer Blocks { uint blockTotals[]; };

shared uint totals[HASH_GROUP];

void main() {
  uint each = (self.bucketBlocks + uint(HASH_GROUP) - 1u) / uint(HASH_GROUP);
  uint lane = gl_LocalInvocationID.x;
  uint first = lane * each;
  uint total = 0u;
  for (uint k = 0u; k < each; ++k)
    if (first + k < self.bucketBlocks) total += blockTotals[first + k];
  totals[lane] = total;
  barrier();
  for (uint reach = 1u; reach < uint(HASH_GROUP); reach *= 2u) {
    uint left = lane >= reach ? totals[lane - reach] : 0u;
    barrier();
    totals[lane] += left;
    barrier();
  }
  uint start = totals[lane] - total;
  for (uint k = 0u; k < each; ++k) {
    if (first + k >= self.bucketBlocks) break;
    uint count = blockTotals[first + k];
    blockTotals[first + k] = start;
    start += count;
  }
}
