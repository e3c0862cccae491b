// The matrix of a coarse level beyond the first, P^T A P, a block an invocation.
#include "sim/implicit/level.glsl"
#include "sim/implicit/shifted_source.glsl"
#include "sim/implicit/store_block.glsl"

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.endBlock - level.firstBlock)) return;
  uint number = level.firstBlock + i;
  uvec4 block = texelFetch(coarsePairs, int(number));
  RigidBlock sum = noBlock();
  for (uint k = block.z; k < block.w; ++k) addBlock(sum, shiftedSource(k, block.xy));
  storeBlock(sum, number, block.xy);
}
