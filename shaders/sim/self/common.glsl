// What all passes of self-collision see (src/solver/self_collision.h says what is computed and why). The hash: particles sorted
// by bucket; a bucket holds the particles of one or several cells, and x-neighbours share three buckets in a row.
#include "shared/self_collision.h"

layout(std140, binding = SELF_PARAMS_BINDING) uniform SelfBlock { SelfParams self; };
layout(binding = HASHED_POSITIONS_UNIT) uniform samplerBuffer hashedPositions;
layout(binding = BUCKETS_UNIT) uniform usamplerBuffer bucketStarts;
layout(binding = BUCKET_BLOCKS_UNIT) uniform usamplerBuffer bucketBlockStarts;
layout(binding = SORTED_UNIT) uniform samplerBuffer sortedParticles;
layout(binding = CANDIDATES_UNIT) uniform usamplerBuffer candidates;
layout(binding = CONTACT_DISTANCES_UNIT) uniform samplerBuffer contactDistances;

layout(std430, binding = CONTACT_FLAGS_BINDING) coherent buffer ContactFlags {
  uint stale;         // some particle has moved too far for the hash
  uint fast;          // or within this step for the search
  uint tooNear;       // some pair of non-adjacent particles is nearer than D
  uint clamping;      // the same, once the plan for it is made
  uint hashBuilds;    // so far,
  uint fastSteps;     // and steps with these
  uint clampedSteps;
  uint broken;        // there was divergence (sim/watch.glsl): contacts in broken numbers could take minutes, and are left out
  uint groupsDone;
}
contacts;
#define GROUPS_DONE contacts.groupsDone

const uint INDEX_MASK = (1u << CANDIDATE_BITS) - 1u;

// A small whole number in a float's bits such that no driver takes it for a denormal or NaN.
float packedIndex(uint i) { return uintBitsToFloat(0x40000000u | i); }
uint unpackedIndex(float x) { return floatBitsToUint(x) & INDEX_MASK; }

int cellCoordinate(float x) {
  const float largest = 131072.0;  // 2^17
  precise float c = x * self.inverseCell;
  c = c < largest ? c : largest;  // NaN, too
  c = c < -largest ? -largest : c;
  return int(floor(c));
}
ivec3 cellOf(vec3 x) { return ivec3(cellCoordinate(x.x), cellCoordinate(x.y), cellCoordinate(x.z)); }

uint bucketOf(ivec3 cell) {
  uint h = uint(cell.y) * 0x9e3779b1u;
  h = (h ^ (h >> 15)) + uint(cell.z) * 0x85ebca77u;
  h = (h ^ (h >> 13)) * 0xc2b2ae3du;
  return ((h ^ (h >> 16)) + uint(cell.x)) & self.bucketMask;
}

uint firstEntry(uint bucket) {
  if (bucket > self.bucketMask) return self.particles;
  return texelFetch(bucketStarts, int(bucket)).x + texelFetch(bucketBlockStarts, int(bucket / BUCKETS_A_BLOCK)).x;
}
