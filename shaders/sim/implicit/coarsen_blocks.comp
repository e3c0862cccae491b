// The matrix of a coarse level beyond the first as coarsen.comp works it out, on devices with fast shared memory: a work group
// takes a block. What its sources add is worked out side by side, some at a time; then every invocation adds up its own number of
// the block, in their order.
#include "sim/implicit/level.glsl"
#include "sim/implicit/shifted_source.glsl"
#include "sim/implicit/store_block.glsl"

const uint NUMBERS = 36u, SOURCES = uint(COARSE_BLOCK_LANES);
shared float parts[SOURCES * (NUMBERS + 1u)];  // by source; one more, so that neighbours lie in other banks
shared float sums[NUMBERS];

void put(uint first, vec3 columns[3]) {
  for (uint c = 0u; c < 3u; ++c)
    for (uint r = 0u; r < 3u; ++r) parts[first + 3u * c + r] = columns[c][r];
}
void take(uint first, out vec3 columns[3]) {
  for (uint c = 0u; c < 3u; ++c) columns[c] = vec3(sums[first + 3u * c], sums[first + 3u * c + 1u], sums[first + 3u * c + 2u]);
}

void main() {
  if (isSkipped()) return;
  uint i = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;
  if (i >= level.endBlock - level.firstBlock) return;
  uint number = level.firstBlock + i;
  uvec4 block = texelFetch(coarsePairs, int(number));
  precise float sum = 0.0;
  for (uint first = block.z; first < block.w; first += SOURCES) {
    uint count = min(SOURCES, block.w - first);
    if (lane < count) {
      RigidBlock part = shiftedSource(first + lane, block.xy);
      uint place = (NUMBERS + 1u) * lane;
      put(place, part.tt);
      put(place + 9u, part.tr);
      put(place + 18u, part.rt);
      put(place + 27u, part.rr);
    }
    barrier();
    if (lane < NUMBERS)
      for (uint k = 0u; k < count; ++k) sum = sum + parts[(NUMBERS + 1u) * k + lane];
    barrier();
  }
  if (lane < NUMBERS) sums[lane] = sum;
  barrier();
  if (lane != 0u) return;
  RigidBlock whole;
  take(0u, whole.tt);
  take(9u, whole.tr);
  take(18u, whole.rt);
  take(27u, whole.rr);
  storeBlock(whole, number, block.xy);
}
