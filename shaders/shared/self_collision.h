// Self-collision: what both backends need for a step, evaluated on the host. Included by GLSL (std140) and by
// C++, where `real` is float for the bitwise twin and double for tests of the physics. Lengths in m.
#ifdef __cplusplus
#pragma once
#include <cstdint>
namespace clothsim::shared {
using uint = std::uint32_t;
#define SHARED_STRUCT   \
  template <class real> \
  struct
#else
#define SHARED_STRUCT struct
#define real float
#endif

#define SELF_PARAMS_BINDING 2  // uniform block

// Storage blocks. Passes that build the hash and passes that use it never run at once, so some share a place.
#define CONTACT_FLAGS_BINDING 4
#define BUCKET_COUNTS_BINDING 5
#define HASHED_BINDING 6
#define BUCKET_BLOCKS_BINDING 6
#define BUCKETS_BINDING 7
#define CANDIDATES_BINDING 7
#define DISPATCHES_BINDING 7

// Buffers read as texels
#define POSITIONS_TO_HASH_UNIT 9
#define HASHED_POSITIONS_UNIT 10   // by particle: position when hashed, and its rank in the bucket
#define BUCKETS_UNIT 11            // first entry of every bucket, within its block of buckets
#define BUCKET_BLOCKS_UNIT 12      // first entry of every block of buckets
#define SORTED_UNIT 13             // position and particle by bucket
#define CANDIDATES_UNIT 14         // slot * particles + particle; the row after the last slot counts them
#define CONTACT_DISTANCES_UNIT 15  // 64 a grid

// Far particles that a particle remembers between two builds of the hash in slots. Who has more walks through
// the cells on the GPU, and remembers the others in a list on the CPU.
#define MOST_CANDIDATES 24u
// A candidate is a particle (26 bits) and, above it, how to find the pair's distance: 0 for non-adjacent
// particles, |columns| + 8 |rows| for particles of one piece that lie nearer than the contact distance at
// rest, 64ths of that for those of one mesh.
#define CANDIDATE_BITS 26
#define NEAREST_CODES 64u

#define HASH_GROUP 256         // work group of passes over particles or buckets
#define BUCKETS_A_BLOCK 4096u  // prefix sums run in blocks

SHARED_STRUCT SelfParams {
  uint particles;   // of all pieces
  uint bucketMask;  // buckets - 1; a power of two, at least as many as particles
  uint bucketBlocks;
  uint firstCode;  // pairs of one piece within so many columns and rows are left to their springs: 1 none, 2
                   // a cell

  real inverseCell;      // 1 / size of a cell
  real searchSquared;    // particles nearer than this when hashed are candidates
  real reuseSquared;     // how far a particle may have moved since [m^2]
  real inverseTimeStep;  // [1/s]

  real distance;       // that is kept between non-adjacent particles
  real unitsPerMeter;  // contact sums are fixed-point units,
  real moveFactor;     // a mean of fixed-point units times this is the move in metres
  real largestMove;    // in a step, robust only

  real friction;       // Coulomb's, between layers, robust only
  real clampFactor;    // a step never ends with a pair of non-adjacent particles nearer than this times its
                       // distance, robust only
  real fastSquared;    // farther than this within a step a particle could slip past another unseen [m^2]
  real codesPerMeter;  // of a mesh: a code is so much of the distance at rest

  uint gridGroups;  // work groups of a pass over all grids; of the GPU only
  uint unusedA;
  uint unusedB;
  uint unusedC;
};

#ifdef __cplusplus
#undef SHARED_STRUCT
}  // namespace clothsim::shared
#endif
