// Minus the inverse of the matrix of a connected part of the coarsest level, a work group each. Every pivot in turn is swept out
// (Goodnight 1979, "A tutorial on the SWEEP operator"); the twin is invertDense() of src/solver/cpu/multilevel.cpp.
// The unknowns of the vertex that is held most stiffly are replaced by the motion of all vertices as one rigid body about its
// center: A' = Q^T A Q. The cloth as a whole, which is soft, then has entries of its own and is no difference of stiff ones. At
// the end A^-1 = Q A'^-1 Q^T.
#include "shared/implicit.h"
#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/rigid_block.glsl"
#include "sim/implicit/dense_part.glsl"

const uint LANES = WORK_GROUP_COLUMNS;
layout(local_size_x = WORK_GROUP_COLUMNS) in;

layout(binding = CENTERS_UNIT) uniform samplerBuffer centers;
layout(binding = COARSE_BLOCKS_UNIT) uniform samplerBuffer coarseBlocks;
layout(binding = COARSE_PAIRS_UNIT) uniform usamplerBuffer coarsePairs;
layout(std430, binding = DENSE_BINDING) coherent buffer Dense { float dense[]; };

shared float scales[6 * COARSEST_VERTICES];  // of pivots, at first the entries that they begin as
// 1024 lanes can keep the largest matrix in registers, each every SIDEth entry across and along.
const uint SIDE = 32u, KEPT = (6u * COARSEST_VERTICES + SIDE - 1u) / SIDE;
shared float column[SIDE * KEPT];
shared uint blocksOfAll[COARSEST_VERTICES];  // of each row that of all vertices
shared uint held;                            // the vertex that is held most stiffly from outside, the first of several

void findHeld(DensePart part, uint lane) {
  for (uint k = part.firstBlock + lane; k < part.endBlock; k += LANES) {
    uvec2 pair = texelFetch(coarsePairs, int(k)).xy;
    if (pair.y == ALL_VERTICES) blocksOfAll[pair.x - part.first] = k;
  }
  barrier();
  if (lane == 0u) {
    held = 0u;
    float most = 0.0;
    for (uint k = 0u; k < part.count; ++k) {
      int first = int(BLOCK_TEXELS * blocksOfAll[k]);
      precise float stiffness =
          (texelFetch(coarseBlocks, first).x + texelFetch(coarseBlocks, first + 1).y) + texelFetch(coarseBlocks, first + 2).z;
      held = stiffness > most ? k : held;
      most = stiffness > most ? stiffness : most;
    }
  }
  barrier();
}

// From the center of that vertex.
vec3 offsetOf(DensePart part, uint vertex) {
  precise vec3 offset = texelFetch(centers, int(part.first + vertex)).xyz - texelFetch(centers, int(part.first + held)).xyz;
  return offset;
}

float entryOf(RigidBlock block, uint i, uint j) {
  if (j < 3u) return i < 3u ? block.tt[j][i] : block.rt[j][i - 3u];
  return i < 3u ? block.tr[j - 3u][i] : block.rr[j - 3u][i - 3u];
}
void put(DensePart part, RigidBlock block, uint row, uint column) {
  uint order = 6u * part.count, first = part.firstEntry;
  for (uint j = 0u; j < 6u; ++j)
    for (uint i = row == column ? j : 0u; i < 6u; ++i) {
      float entry = canonical(entryOf(block, i, j));
      dense[first + (column + j) * order + row + i] = entry;
      dense[first + (row + i) * order + column + j] = entry;
    }
}

// The rows and columns of all vertices together. A lane for each vertex, that of the held one for their sum.
void putAll(DensePart part, uint lane) {
  vec3 still = vec3(0.0);
  RigidBlock sum = noBlock();
  if (lane >= part.count) return;
  if (lane != held) {
    addBlock(sum, shiftedBlock(1.0, loadBlock(coarseBlocks, blocksOfAll[lane]), still, offsetOf(part, lane)));
    put(part, sum, 6u * lane, 6u * held);
  } else {
    for (uint k = 0u; k < part.count; ++k) {
      vec3 offset = offsetOf(part, k);
      addBlock(sum, shiftedBlock(1.0, loadBlock(coarseBlocks, blocksOfAll[k]), offset, offset));
    }
    put(part, sum, 6u * held, 6u * held);
  }
}

vec3 threeAt(uint first, uint stride) { return vec3(dense[first], dense[first + stride], dense[first + 2u * stride]); }
void addThree(uint first, uint stride, vec3 v) {
  for (uint c = 0u; c < 3u; ++c) {
    precise float sum = dense[first + c * stride] + v[c];
    dense[first + c * stride] = canonical(sum);
  }
}

// A vertex moves with all, t + r x offset, besides on its own: rows, where the stride is 1, or columns.
void moveWithAll(DensePart part, uint lane, uint stride) {
  uint order = 6u * part.count, across = order + 1u - stride;
  for (uint e = lane; e < part.count * order; e += LANES) {
    if (e / order == held) continue;
    uint vertex = e / order, line = part.firstEntry + e % order * across, own = line + 6u * vertex * stride,
         all = line + 6u * held * stride;
    vec3 t = threeAt(all, stride), r = threeAt(all + 3u * stride, stride);
    precise vec3 moved = t + crossProduct(r, offsetOf(part, vertex));
    addThree(own, stride, moved);
    addThree(own + 3u * stride, stride, r);
  }
  memoryBarrierBuffer();
  barrier();
}

float sweptEntry(float entry, uint i, uint j, uint k, float inverse, float inRow, float other) {
  precise float updated = entry - inRow * other;
  precise float swept = inRow * inverse;
  return canonical(i != k && j != k ? updated : i == j ? -inverse : i == k ? other : swept);
}

// The pivots in the order in which they are swept out: what moves all first, before the rounding of stiff differences is in it.
uint pivotAt(uint place, uint order) { return (6u * held + place) % order; }

// Those of the pivots that are still to come.
void enlargeScales(uint order, uint k, float inverse, uint lane) {
  for (uint i = lane; i < order; i += LANES)
    if (i != k) scales[i] = scaleAfter(scales[i], column[i], inverse, scales[k]);
}

#if WORK_GROUP_COLUMNS == 1024
void sweepOut(uint first, uint order, uint lane) {
  float kept[KEPT * KEPT];
  uvec2 own = uvec2(lane % SIDE, lane / SIDE);  // the first row and column
  for (uint q = 0u; q < KEPT; ++q)
    for (uint r = 0u; r < KEPT; ++r) {
      uint i = own.x + SIDE * r, j = own.y + SIDE * q;
      kept[KEPT * q + r] = i < order && j < order ? dense[first + j * order + i] : 0.0;
    }
  for (uint place = 0u; place < order; ++place) {
    uint k = pivotAt(place, order);
    barrier();
    for (uint q = 0u; q < KEPT; ++q)
      if (own.y + SIDE * q == k)
        for (uint r = 0u; r < KEPT; ++r) column[own.x + SIDE * r] = kept[KEPT * q + r];
    barrier();
    float inverse = inversePivot(column[k], scales[k]);
    enlargeScales(order, k, inverse, lane);
    for (uint q = 0u; q < KEPT; ++q) {
      uint j = own.y + SIDE * q;
      precise float other = column[j] * inverse;
      for (uint r = 0u; r < KEPT; ++r) {
        uint i = own.x + SIDE * r;
        kept[KEPT * q + r] = sweptEntry(kept[KEPT * q + r], i, j, k, inverse, column[i], other);
      }
    }
  }
  for (uint q = 0u; q < KEPT; ++q)
    for (uint r = 0u; r < KEPT; ++r) {
      uint i = own.x + SIDE * r, j = own.y + SIDE * q;
      if (i < order && j < order) dense[first + j * order + i] = kept[KEPT * q + r];
    }
  memoryBarrierBuffer();
}
#else
void sweepOut(uint first, uint order, uint lane) {
  for (uint place = 0u; place < order; ++place) {
    uint k = pivotAt(place, order);
    barrier();
    for (uint i = lane; i < order; i += LANES) column[i] = dense[first + k * order + i];
    barrier();
    float inverse = inversePivot(column[k], scales[k]);
    enlargeScales(order, k, inverse, lane);
    for (uint e = lane; e < order * order; e += LANES) {
      uint i = e % order, j = e / order;
      precise float other = column[j] * inverse;
      dense[first + e] = sweptEntry(dense[first + e], i, j, k, inverse, column[i], other);
    }
    memoryBarrierBuffer();
  }
}
#endif

void invert(DensePart part) {
  uint lane = gl_LocalInvocationID.x, order = 6u * part.count, entries = order * order, first = part.firstEntry;
  for (uint e = lane; e < entries; e += LANES) dense[first + e] = 0.0;
  findHeld(part, lane);
  memoryBarrierBuffer();
  barrier();
  // An entry of a block each.
  for (uint e = lane; e < 36u * (part.endBlock - part.firstBlock); e += LANES) {
    uint number = part.firstBlock + e / 36u, j = e % 36u / 6u, i = e % 6u;
    uvec2 pair = texelFetch(coarsePairs, int(number)).xy;
    if (pair.y >= part.first + part.count) continue;  // of all; or across a cut, where it is 0
    if (pair.x == part.first + held || pair.y == part.first + held) continue;
    if (pair.x == pair.y && i < j) continue;
    uint texel = BLOCK_TEXELS * number + (i < 3u ? 0u : 6u) + (j < 3u ? 0u : 3u) + j % 3u;
    float entry = texelFetch(coarseBlocks, int(texel))[i % 3u];
    uint row = 6u * (pair.x - part.first) + i, own = 6u * (pair.y - part.first) + j;
    dense[first + own * order + row] = entry;
    dense[first + row * order + own] = entry;
  }
  barrier();
  putAll(part, lane);
  memoryBarrierBuffer();
  barrier();
  for (uint k = lane; k < order; k += LANES) scales[k] = dense[first + k * order + k];
  sweepOut(first, order, lane);
  barrier();
  moveWithAll(part, lane, 1u);
  moveWithAll(part, lane, order);
}

void main() {
  if (isSkipped()) return;
  for (uint number = gl_WorkGroupID.x; number < densePartCount(); number += gl_NumWorkGroups.x) {
    invert(densePartAt(number));
    barrier();
  }
}
