// The particles in the 27 cells about a particle's cell, each once.

// The candidate (shared/self_collision.h); EXCLUDED for a pair that is left to its springs.
const uint EXCLUDED = ~0u;

float codeDistance(uint code) {
  return texelFetch(contactDistances, int(step.piece * NEAREST_CODES + code)).x;
}

// Neighbours in one cell are non-adjacent particles once the spring between them is cut: the bit of that spring in a cut mask by its
// direction, 31 for none (springWithinCell() of src/cloth/cuts.h).
const uint springWithinCell[9] = uint[9](2u, 1u, 3u, 0u, 31u, 6u, 8u, 9u, 10u);

bool isCutFrom(GridPoint p, uint column, uint row) {
  return hasCuts && !isIntact(cutMaskOf(p.index), springWithinCell[3u * (row + 1u - p.row) + column + 1u - p.column]);
}

#if SELF_HAS_MESH
#include "shared/mesh_lists.h"
layout(binding = LIST_STARTS_UNIT) uniform usamplerBuffer listStarts;
layout(binding = MESH_SPRINGS_UNIT) uniform usamplerBuffer meshSprings;
layout(binding = REST_PLACES_UNIT) uniform samplerBuffer restPlaces;

bool joins(uint i, uint j) {
  uint end = texelFetch(listStarts, int(i) + 1).x;
  for (uint n = texelFetch(listStarts, int(i)).x; n < end; ++n) {
    uvec2 spring = texelFetch(meshSprings, int(n)).xy;
    if (spring.x == j && (spring.y & STRUCTURAL_SPRING) != 0u) return true;
  }
  return false;
}

// Of two particles of one mesh. Pairs that are all but one at rest are left alone.
uint encodeOnMesh(uint i, uint j) {
  precise vec3 d = texelFetch(restPlaces, int(i)).xyz - texelFetch(restPlaces, int(j)).xyz;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float rest = lengthSquared * inverseLength;
  precise float code = self.codesPerMeter * rest;
  if (!(code < float(NEAREST_CODES))) return j;
  if (code < 1.0 || (self.firstCode > 1u && joins(i, j))) return EXCLUDED;
  return j | uint(int(code)) << CANDIDATE_BITS;
}
#endif

#if HAS_SEAMS
#include "sim/seams.glsl"
#endif

uint encode(GridPoint p, uint j) {
#if HAS_SEAMS
  if (areNearSeam(p.index, j)) return EXCLUDED;
#endif
  uint inPiece = j - step.firstParticle;
  if (inPiece >= step.columns * step.rows) return j;
#if SELF_HAS_MESH
  if (step.isMesh != 0u) return encodeOnMesh(p.index, j);
#endif
  uint column = inPiece % step.columns, row = inPiece / step.columns;
  uint across = column < p.column ? p.column - column : column - p.column;
  uint along = row < p.row ? p.row - row : row - p.row;
  if (across < self.firstCode && along < self.firstCode && !isCutFrom(p, column, row)) return EXCLUDED;
  if (SELF_NEAR_CODES == 0 || across > 7u || along > 7u) return j;
  uint code = across + 8u * along;
  return codeDistance(code) < self.distance ? j | code << CANDIDATE_BITS : j;
}

// Nine runs of three buckets; a run that wraps at the end of the table falls into two.
struct Run {
  uint first, end, secondEnd;  // entries: [first, end), then [0, secondEnd)
  ivec2 yz;                    // cells with other y or z only share the buckets
};

Run runOf(ivec3 cell, int k) {
  ivec2 yz = cell.yz + ivec2(k % 3 - 1, k / 3 - 1);
  uint left = bucketOf(ivec3(cell.x - 1, yz));
  uint last = left + 2u;
  uint wrapped = last > self.bucketMask ? last - self.bucketMask : 0u;
  return Run(firstEntry(left), firstEntry(wrapped > 0u ? self.bucketMask + 1u : last + 1u),
             wrapped > 0u ? firstEntry(wrapped) : 0u, yz);
}

bool isInRun(Run run, vec4 entry) {
  return cellCoordinate(entry.y) == run.yz.x && cellCoordinate(entry.z) == run.yz.y;
}
