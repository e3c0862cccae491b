// The matrix of a coarse level beyond the first, P^T A P, a block an invocation.
#include "sim/implicit/level.glsl"
#include "sim/implicit/store_block.glsl"

layout(binding = COARSE_BLOCKS_UNIT) uniform samplerBuffer coarseBlocks;

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.endBlock - level.firstBlock)) return;
  uint number = level.firstBlock + i;
  uvec4 block = texelFetch(coarsePairs, int(number));
  bool isOfAll = block.y == ALL_VERTICES;
  vec3 rowCenter = centerAt(block.x), columnCenter = centerAt(isOfAll ? block.x : block.y);
  RigidBlock sum = noBlock();
  for (uint k = block.z; k < block.w; ++k) {
    uint source = texelFetch(coarseSources, int(k)).x;
    bool isTransposed = source % 2u != 0u;
    uvec2 fine = texelFetch(coarsePairs, int(source / 2u)).xy;
    fine = isTransposed ? fine.yx : isOfAll ? fine.xx : fine;
    float columnWeight = isOfAll ? 1.0 : weightOn(step.totalParticles + fine.y, block.y);
    precise float weight = weightOn(step.totalParticles + fine.x, block.x) * columnWeight;
    RigidBlock stored = loadBlock(coarseBlocks, source / 2u);
    if (isTransposed) stored = transposedBlock(stored);
    precise vec3 p = centerAt(fine.x) - rowCenter;
    precise vec3 q = centerAt(fine.y) - columnCenter;
    addShifted(sum, weight, stored, p, q);
  }
  storeBlock(sum, number, block.xy);
}
