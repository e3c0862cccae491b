// The cloth as a surface that touches itself and other cloth (src/solver/surface.h). Included by GLSL
// (std430) and by C++, where `real` is float for the bitwise twin and double for tests of the physics. Rows
// of 16 bytes.
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

// A box of the tree has so many children; its lowest boxes are those of single triangles.
#define BOX_CHILDREN 4u
#define MOST_BOX_LEVELS 16

// A grid is looked at in blocks of so many cells in each direction: near each other they may be too flat for
// parts of them to meet (surface_laws.h).
#define BLOCK_CELLS 4
#define NO_BLOCK 0xffffffffu

#define NO_PARTICLE 0xffffffffu  // where a side has no second triangle

// Of SurfaceTriangle::owned: bit k says that the triangle looks for contacts of its corner k, bit 3 + k of
// its side from corner k to the next one. Of the triangles that share one, the first does.
#define OWNED_SIDE 3
// And this bit says that corners of it are sewn: behind all triangles lies a row for each, which has the
// joints of its corners (ClothSurface::joints).
#define IS_SEWN 6

// Which part of a triangle is nearest: its face, the corner 1 + k, or the side 4 + k.
#define NEAREST_FACE 0u
#define NEAREST_CORNER 1u
#define NEAREST_SIDE 4u

// A step is solved so many times at most: it goes on from where motion was cut short, or parts were pushed
// far apart. Otherwise the cloth around would be stretched, by half its length where silk falls into folds.
#define CONTACT_ROUNDS 4
// Further than this part of the largest push is far.
#define FAR_PUSH 0.25f

// Rounds of the guard: in the first ones, pairs that the motion so far brings too near are pushed apart. In
// the others they keep to their own sides; in the last one, if there were some in the round before, all do.
#define GUARD_ROUNDS 16
#define CORRECTION_ROUNDS 8
// Parts that come nearer than this part of their gap are too near.
#define KEPT_GAP 0.95f
// What is flat keeps parts apart by so many least gaps, at least.
#define LEAST_GAPS_OF_FLAT 4.0f
// Where parts turn about each other, the motion is looked at in so many parts.
#define FINE_PARTS 8
// A particle's correction counts in so many parts.
#define CORRECTION_WEIGHT 1024

// A pair that touches is pushed apart with this many times the stiffness of its inertia, and with what its
// springs add (CONTACT_OVER_SPRINGS).
#define PAIR_OVER_INERTIA 100.0f
// Nearer than half of its thickness a pair is pushed more stiffly, down to this part of it.
#define SQUEEZED 0.02f

// A triangle that finds more pairs than this stops looking, and its step has too many.
#define MOST_PAIRS_A_TRIANGLE 4096u
// Approaches below this are none: their reciprocals would not be safe [m].
#define LEAST_APPROACH 8.67361737988403547205962240695953369140625e-19f  // 2^-60

// Counts are summed up in blocks of so many, a work group each.
#define SURFACE_LANES 256
#define SURFACE_BLOCK 2048u

// An invocation an entry, in work groups of so many; dispatches of many groups have rows.
#define SURFACE_GROUP 64
#define GROUPS_A_ROW 4096u

// Small colliders: in the first round friction stops slips, in the others triangles that are still in them
// are pushed out; and rounds of the search for where a triangle meets their cores.
#define PRESS_ROUNDS 9
// Deeper than this part of its radius, or of its reach, what is left in a collider at the end of a step is
// pushed out, to half of that depth: the solution leaves a little, as a stiff spring does.
#define LEFT_INSIDE 0.0625f
// The cosine between normals of a surface that turns little within a triangle.
#define SAME_FACE 0.75f
#define MOST_OVER_INERTIA 1048576.0f  // of a pair's stiffness, what springs add: 1 / LEAST_PIVOT
#define CORE_ROUNDS 6
#define CROSSING_ROUNDS 16
// Rounds of the search for the place of a triangle that is deepest in a shape, and halvings in each.
#define DEEPEST_ROUNDS 3
#define DEEPEST_HALVINGS 6

#define SURFACE_PARAMS_BINDING 3  // uniform blocks
#define GUARD_ROUND_BINDING 4
#define SURFACE_STATE_BINDING 6  // storage blocks; each pass binds what it needs
#define SURFACE_COUNTS_BINDING 4
#define SURFACE_LISTS_BINDING 5
#define SURFACE_OUT_BINDING 0
#define SURFACE_IDS_BINDING 1
#define SURFACE_VELOCITIES_BINDING 2

#define SURFACE_TRIANGLES_UNIT 50  // two texels each, and one more with seams
#define SURFACE_POINTS_UNIT 51
#define SURFACE_BOXES_UNIT 52  // three texels each (boundsOf() in sim/surface/common.glsl)
#define PAIR_IDS_UNIT 53       // four particles
#define PAIR_ROWS_UNIT \
  54  // four texels each: normal, over; weights; stiffness, pressed, limit, held; force, across. Pressed is
      // how the parts pressed in the last Newton step, or for a small collider its number: -1, -2 ...
#define PAIR_STARTS_UNIT 55     // of a particle's entries, within its block
#define PAIR_BLOCKS_UNIT 56     // what the blocks of particles begin with
#define PAIR_ENTRIES_UNIT 57    // 4 * pair + place in it
#define SURFACE_BLOCKS_UNIT 58  // what the blocks of triangles begin with
#define SURFACE_STARTS_UNIT 59  // where the motion of a round begins
#define FLAT_BLOCKS_UNIT 60     // three texels each
#define FLAT_SIDES_UNIT 61  // four texels each: of the sides along rows the lowest and highest, of the others
#define FLAT_FLAGS_UNIT 62  // whether a block and those around it are flat
#define SMALL_COLLIDERS_UNIT 63  // two texels each
#define PAIR_CARRIES_UNIT 64     // how far a small collider carries the pair along, less its elastic slip
#define PAIR_SLIPS_UNIT \
  68  // two texels each: elastic slip as bits, and the pair's place; what held (LEAST_HELD)
#define KEPT_IDS_UNIT 69    // of the pairs of the step before: particles,
#define KEPT_SLIPS_UNIT 70  // and the same
#define SURFACE_RINGS_UNIT \
  71  // the particles around each: where those of a particle begin, for each and one more, then they
#define SURFACE_CARRIES_BINDING 1
#define PAIR_SLIPS_BINDING 2
#define SURFACE_MOVED_BINDING 7

struct SurfaceBlock {
  uint first;   // particle
  uint stride;  // from row to row
  uint width;   // in particles; neighbours share those between them
  uint height;

  uint column;  // its place among the blocks of its grid, which has so many
  uint row;
  uint columns;
  uint rows;

  uint firstOfGrid;  // block
  float perAlong;    // reciprocal distances of columns and rows [1/m]
  float perDown;
  float apart;  // of parts of the grid that have no particle in common, at least [m]
};

struct SurfaceTriangle {
  uint cornerA;
  uint cornerB;
  uint cornerC;
  uint owned;

  uint acrossAB;  // the third corner of the other triangle at this side, or NO_PARTICLE
  uint acrossBC;
  uint acrossCA;
  uint block;  // of a grid that is whole, or NO_BLOCK
};

// What a particle brings into contact.
SHARED_STRUCT SurfacePoint {
  real radius;     // half of the thickness [m]
  real friction;   // Coulomb's coefficient
  real share;      // of a contact at this corner that each of its triangles finds
  real stiffness;  // what its springs add to a contact [N/m]
};

// A collider that is thin or sharp against the cells of the cloth and acts on triangles, too. Its core lies
// in the middle of it, in its own frame: no triangle may pass that. It is a box, as small as a point or a
// segment, or, where outerRadius is above 0, all that is around y between the radii coreX and outerRadius
// [m].
SHARED_STRUCT SmallCollider {
  real number;  // among the scene's
  real bound;   // all that counts as near is so near to its center [m]
  real radius;  // how thick it is around the core [m]
  real near;    // what is so near to the core counts as near [m]

  real coreX;  // half sizes of the core [m]
  real coreY;
  real coreZ;
  real outerRadius;  // below 0: it is so thick that nothing of the core counts
};

// What contact has come to.
struct SurfaceState {
  // Of this step:
  uint tooMany;    // 1: there was no room for all pairs; 2: the state is broken, and nothing is looked for
  uint pairs;      // that may touch
  uint isGuarded;  // some motion was cut short
  uint isLater;    // the step goes on from where motion was cut short or parts were pushed far apart,

  uint tooNear[GUARD_ROUNDS];  // by round of the guard: some pair was

  uint isSettled;     // or would have, but there was none
  uint moved;         // on the GPU, particles that this round of the guard has moved or held back so far
  uint keptPairs;     // on the GPU, how many pairs the step before had
  uint wasPushedFar;  // of this step so far: some part was pushed far (FAR_PUSH)

  // Of all steps:
  uint mostPairs;     // in a step; also those that there was no room for
  uint shortened;     // motions of particles that were cut short
  uint guardedSteps;  // in which there were some
  uint crowdedSteps;  // in which there were too many pairs, so that none pushed

  uint leastGap;           // of pairs that may touch, the bits of a float [m]
  uint isFlat;             // of this round: the only cloth is too flat for parts of it to meet
  uint pinLag;             // the largest ways, bits of floats: that pins were kept from theirs,
  uint largestCorrection;  // and that pairs that were too near were pushed apart [m]

  uint isPressed;     // of this step: some triangle was pushed out of a small collider
  uint passages;      // of triangles by cores of small colliders,
  uint passageSteps;  // and steps with some
  uint groupsDone;    // on the GPU, work groups of the dispatch that is under way; 0 between dispatches
};

// What the passes on the GPU need beside these.
struct SurfaceParams {
  uint triangles;
  int topLevel;  // of boxes
  uint roomForPairs;
  float quantum;

  float around;
  float margin;
  float leastGap;
  float perQuantum;

  float touchingReach;  // parts that may touch are nearer at the start or end [m]
  uint blocks;
  uint isOneGrid;
  uint touchesItself;  // cloth is a collider, too

  uint smallColliders;  // how many there are
  float largestPush;    // that one pair asks for [m]
  uint unusedA;
  uint unusedB;

#ifdef __cplusplus
  uint firstBoxes[MOST_BOX_LEVELS][4];
#else
  uvec4 firstBoxes[MOST_BOX_LEVELS];  // in x: std140 spaces the numbers of an array like that
#endif
};

struct GuardRound {
  uint number;
  uint unusedA;
  uint unusedB;
  uint unusedC;
};

#ifdef __cplusplus
#undef SHARED_STRUCT
}  // namespace clothsim::shared
#endif
