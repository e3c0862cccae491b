// What a source of a block of a coarse level beyond the first adds to it. After sim/implicit/level.glsl.
layout(binding = COARSE_BLOCKS_UNIT) uniform samplerBuffer coarseBlocks;

RigidBlock shiftedSource(uint k, uvec2 pair) {
  bool isOfAll = pair.y == ALL_VERTICES;
  uint source = texelFetch(coarseSources, int(k)).x;
  bool isTransposed = source % 2u != 0u;
  uvec2 fine = texelFetch(coarsePairs, int(source / 2u)).xy;
  fine = isTransposed ? fine.yx : isOfAll ? fine.xx : fine;
  float columnWeight = isOfAll ? 1.0 : weightOn(step.totalParticles + fine.y, pair.y);
  precise float weight = weightOn(step.totalParticles + fine.x, pair.x) * columnWeight;
  RigidBlock stored = loadBlock(coarseBlocks, source / 2u);
  if (isTransposed) stored = transposedBlock(stored);
  precise vec3 p = centerAt(fine.x) - centerAt(pair.x);
  precise vec3 q = centerAt(fine.y) - centerAt(isOfAll ? pair.x : pair.y);
  return shiftedBlock(weight, stored, p, q);
}
