// A level of a grid and the next coarser one; every second point is kept, and the last. The twin of
// src/solver/cpu/multilevel.cpp.
#include "sim/implicit/common.glsl"

layout(std140, binding = LEVEL_PARAMS_BINDING) uniform LevelBlock { LevelParams level; };

// Along one direction: the fine point of a coarse one, and whether the fine points before and behind it lie half way to the
// next coarse ones.
struct FinePlace {
  uint middle;
  bool before, behind;
};

FinePlace finePlace(uint coarse, uint coarseCount, uint fineCount) {
  if (coarseCount == fineCount) return FinePlace(coarse, false, false);
  bool last = coarse + 1u == coarseCount;
  uint middle = last ? fineCount - 1u : 2u * coarse;
  return FinePlace(middle, middle > 0u && middle % 2u == 0u, !last && middle + 2u < fineCount);
}

// The two coarse points around a fine one, the same one twice where it is one itself.
uvec2 coarsePlaces(uint fine, uint coarseCount, uint fineCount) {
  if (coarseCount == fineCount) return uvec2(fine);
  if (fine + 1u == fineCount) return uvec2(coarseCount - 1u);
  return uvec2(fine / 2u, (fine + 1u) / 2u);
}

// Sums over the fine points around a coarse one: a whole for its own place, a half or quarter for those around.
vec3 alongRow(samplerBuffer values, uint row, FinePlace column, uint texels, uint texel) {
  uint i = level.fineFirst + row * level.fineColumns + column.middle;
  vec3 before = column.before ? texelFetch(values, int(texels * (i - 1u) + texel)).xyz : vec3(0.0);
  vec3 behind = column.behind ? texelFetch(values, int(texels * (i + 1u) + texel)).xyz : vec3(0.0);
  precise vec3 sum = texelFetch(values, int(texels * i + texel)).xyz + 0.5 * (before + behind);
  return sum;
}

vec3 gatherFine(samplerBuffer values, FinePlace column, FinePlace row, uint texels, uint texel) {
  vec3 above = row.before ? alongRow(values, row.middle - 1u, column, texels, texel) : vec3(0.0);
  vec3 below = row.behind ? alongRow(values, row.middle + 1u, column, texels, texel) : vec3(0.0);
  vec3 middle = alongRow(values, row.middle, column, texels, texel);
  precise vec3 sum = middle + 0.5 * (above + below);
  return sum;
}

Factors factorsAt(uint i) {
  return Factors(texelFetch(factors, int(2u * i)).xyz, texelFetch(factors, int(2u * i + 1u)).xyz);
}
