// Minus the inverse of the matrix of a connected part of the coarsest level, a work group each. Every pivot in turn is swept out
// (Goodnight 1979, "A tutorial on the SWEEP operator"); the twin is invertDense() of src/solver/cpu/multilevel.cpp.
#include "shared/implicit.h"
#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/rigid_block.glsl"
#include "sim/implicit/dense_part.glsl"

layout(local_size_x = SUM_LANES) in;

layout(binding = COARSE_BLOCKS_UNIT) uniform samplerBuffer coarseBlocks;
layout(binding = COARSE_PAIRS_UNIT) uniform usamplerBuffer coarsePairs;
layout(std430, binding = DENSE_BINDING) coherent buffer Dense { float dense[]; };

shared float began[6 * COARSEST_VERTICES];
shared float column[6 * COARSEST_VERTICES];

void invert(DensePart part) {
  uint lane = gl_LocalInvocationID.x, order = 6u * part.count, entries = order * order, first = part.firstEntry;
  for (uint e = lane; e < entries; e += uint(SUM_LANES)) dense[first + e] = 0.0;
  memoryBarrierBuffer();
  barrier();
  // An entry of a block each.
  for (uint e = lane; e < 36u * (part.endBlock - part.firstBlock); e += uint(SUM_LANES)) {
    uint number = part.firstBlock + e / 36u, j = e % 36u / 6u, i = e % 6u;
    uvec2 pair = texelFetch(coarsePairs, int(number)).xy;
    if (pair.y >= part.first + part.count) continue;  // across a cut, where it is 0
    uint texel = BLOCK_TEXELS * number + (i < 3u ? 0u : 6u) + (j < 3u ? 0u : 3u) + j % 3u;
    float entry = texelFetch(coarseBlocks, int(texel))[i % 3u];
    uint row = 6u * (pair.x - part.first) + i, own = 6u * (pair.y - part.first) + j;
    dense[first + own * order + row] = entry;
    if (pair.x != pair.y) dense[first + row * order + own] = entry;
  }
  memoryBarrierBuffer();
  barrier();
  for (uint k = lane; k < order; k += uint(SUM_LANES)) began[k] = dense[first + k * order + k];
  for (uint k = 0u; k < order; ++k) {
    barrier();
    for (uint i = lane; i < order; i += uint(SUM_LANES)) column[i] = dense[first + k * order + i];
    barrier();
    float inverse = inversePivot(column[k], began[k]);
    for (uint e = lane; e < entries; e += uint(SUM_LANES)) {
      uint i = e % order, j = e / order;
      precise float other = column[j] * inverse;
      precise float updated = dense[first + e] - column[i] * other;
      precise float swept = column[i] * inverse;
      float next = i != k && j != k ? updated : i == j ? -inverse : i == k ? other : swept;
      dense[first + e] = canonical(next);
    }
    memoryBarrierBuffer();
  }
}

void main() {
  if (isSkipped()) return;
  for (uint number = gl_WorkGroupID.x; number < densePartCount(); number += gl_NumWorkGroups.x) {
    invert(densePartAt(number));
    barrier();
  }
}
