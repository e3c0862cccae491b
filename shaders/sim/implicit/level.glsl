// A level of a grid and the next coarser one; every second point is kept, and the last. The twin of
// src/solver/cpu/multilevel.cpp.
#include "sim/implicit/common.glsl"

layout(std140, binding = LEVEL_PARAMS_BINDING) uniform LevelBlock { LevelParams level; };

#if HAS_CUTS
layout(binding = CUT_LINKS_UNIT) uniform usamplerBuffer cutLinks;
uint cutLinksOf(uint i) { return texelFetch(cutLinks, int(i)).x; }
#else
uint cutLinksOf(uint i) { return 0u; }
#endif

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

// The fine vertices around a coarse one.
struct Fine {
  uint middle;
  FinePlace column, row;
  uint links;
};

Fine fineAround(uvec2 coarse) {
  FinePlace column = finePlace(coarse.x, level.coarseColumns, level.fineColumns);
  FinePlace row = finePlace(coarse.y, level.coarseRows, level.fineRows);
  uint middle = level.fineFirst + row.middle * level.fineColumns + column.middle;
  return Fine(middle, column, row, cutLinksOf(middle));
}

vec3 valueOf(samplerBuffer values, Fine fine, int columns, int rows, uint texels, uint texel) {
  int i = int(fine.middle) + rows * int(level.fineColumns) + columns;
  return (fine.links & LINK_BIT(columns, rows)) != 0u ? vec3(0.0) : texelFetch(values, int(texels) * i + int(texel)).xyz;
}

// Sums over them: a whole for the coarse vertex' own place, a half or quarter for those around that it is not cut off from.
vec3 alongRow(samplerBuffer values, Fine fine, int rows, uint texels, uint texel) {
  vec3 before = fine.column.before ? valueOf(values, fine, -1, rows, texels, texel) : vec3(0.0);
  vec3 behind = fine.column.behind ? valueOf(values, fine, 1, rows, texels, texel) : vec3(0.0);
  precise vec3 sum = valueOf(values, fine, 0, rows, texels, texel) + 0.5 * (before + behind);
  return sum;
}

vec3 gatherFine(samplerBuffer values, Fine fine, uint texels, uint texel) {
  vec3 above = fine.row.before ? alongRow(values, fine, -1, texels, texel) : vec3(0.0);
  vec3 below = fine.row.behind ? alongRow(values, fine, 1, texels, texel) : vec3(0.0);
  vec3 middle = alongRow(values, fine, 0, texels, texel);
  precise vec3 sum = middle + 0.5 * (above + below);
  return sum;
}

Factors factorsAt(uint i) {
  return Factors(texelFetch(factors, int(2u * i)).xyz, texelFetch(factors, int(2u * i + 1u)).xyz);
}
