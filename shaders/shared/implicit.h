// The implicit integrator: what both backends need besides the parameters of a step. Included by GLSL
// (std140) and by C++, where `real` is float for the bitwise twin and double for tests of the physics. Rows
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

#define LEVEL_PARAMS_BINDING 4  // uniform block

// Storage blocks, by array (src/solver/pass.h). What no pass writes together may share a binding.
#define RIGHT_HAND_SIDES_BINDING 4
#define RESIDUALS_BINDING 4
#define CORRECTIONS_BINDING 1
#define DIRECTIONS_BINDING 4
#define PRODUCTS_BINDING 5
#define CONTACT_PLANES_BINDING 4
#define CONTACT_BLOCKS_BINDING 1
#define HISTORIES_BINDING 4
#define NEW_ELASTIC_SLIPS_BINDING 4
#define PARTIAL_SUMS_BINDING 0
#define CENTERS_BINDING 4
#define COARSE_BLOCKS_BINDING 4
#define DENSE_BINDING 4
#define DISPLACEMENTS_BINDING 5
#define INCREMENTS_BINDING 5
#define COARSE_INVERSES_BINDING 5
#define ITERATES_BINDING 6
#define FACTORS_BINDING 6
#define AIR_BLOCKS_BINDING 1
#define SCALARS_BINDING 7

// Buffers read as texels, a vec4 a particle; the first two of them go on with the coarse vertices.
#define RESIDUALS_UNIT 25    // r = minus the gradient of the energy, later that of the linear system [N]
#define CORRECTIONS_UNIT 26  // z = preconditioned r [m]
#define FACTORS_UNIT 27      // two texels each: L D L^T of the diagonal block, l21 l31 l32 and 1/d1 1/d2 1/d3
#define RIGHT_HAND_SIDES_UNIT \
  29  // b, and the diagonal a, of the energy 1/2 a |d|^2 - b.d of inertia, air and grabs
#define AIR_BLOCKS_UNIT 30     // two texels each: what the air adds to a, a symmetric matrix
#define DISPLACEMENTS_UNIT 31  // d, from the start of the step [m]
#define ITERATES_UNIT 32       // x + d, and the inverse mass
#define DIRECTIONS_UNIT 33     // p of conjugate gradients, and the inverse mass
#define PRODUCTS_UNIT 34       // H p; later a particle's change of energy at four lengths of the Newton step
#define INCREMENTS_UNIT 35     // the Newton step so far [m]
#define STARTS_UNIT 36         // x at the start of the step, and the inverse mass
#define CONTACT_PLANES_UNIT \
  39  // two texels each: n and offset, carry and friction (src/solver/cpu/collide.h)
#define CONTACT_BLOCKS_UNIT \
  48  // two texels each: what a plane adds to the Hessian, a symmetric matrix, and the limit of friction

#define HISTORIES_UNIT \
  49  // two texels each, of `bdf2`: a third of what place and velocity changed in the last step

#define ELASTIC_SLIPS_UNIT \
  67  // of friction on planes, that the last step has left [m], and what held then (LEAST_HELD)

// Of the coarse levels (src/solver/hierarchy.h).
#define CENTERS_UNIT 40          // of aggregates [m]
#define COARSE_BLOCKS_UNIT 41    // BLOCK_TEXELS a block of a level's matrix
#define COARSE_INVERSES_UNIT 42  // BLOCK_TEXELS a coarse vertex: its inverted diagonal block
#define PROLONGATION_STARTS_UNIT 43
#define PROLONGATION_UNIT 44
#define RESTRICTION_STARTS_UNIT 45
#define RESTRICTION_UNIT 46
#define COARSE_PAIRS_UNIT 47  // row, column, sources of a block
#define COARSE_SOURCES_UNIT 28
#define DENSE_UNIT 38        // minus the inverses of the coarsest matrices, a number each
#define DENSE_PARTS_UNIT 37  // two texels each: DensePart

// A coarse vertex moves as a rigid body: it has a translation and a rotation about its center, a texel each.
// A block joins those of two vertices: the columns of four matrices of 3 x 3, translation by translation,
// translation by rotation, rotation by translation, rotation by rotation.
#define VERTEX_TEXELS 2
#define BLOCK_TEXELS 12

// The coarsest level of connected cloth has at most so many vertices.
#define COARSEST_VERTICES 25
// What a pivot that counts is at least, of its scale (src/solver/cpu/rigid_block.h): below, binary32 holds no
// more of it.
#define LEAST_PIVOT 0x1p-20

// The column of a row's last block: it joins the vertex of the row to all vertices of the level, moving as
// one rigid body (src/solver/hierarchy.h).
#define ALL_VERTICES 0xffffffffu

// On the GPU one work group takes at most so many levels alone.
#define LEVELS_ALONE 15

// Sums over all particles have one order: lane t of 256 adds every 256th number of a block of 1024, the lanes
// are added as a tree, and so are the blocks.
#define SUM_LANES 256
#define COARSE_BLOCK_LANES 64  // of sim/implicit/coarsen_blocks.comp
#define SUM_BLOCK 1024u
// Passes over all particles take them in rows of so many.
#define PARTICLES_A_ROW 16384u

// A step of `bdf2` is of second order after so many usual ones: an impact can take two steps.
#define USUAL_STEPS 2u

// Lengths of the Newton step that the line search looks at: 1, 1/2, 1/4, 1/8. It takes the first that does
// not raise the energy.
#define LENGTHS_TRIED 4

// A plane that a particle is behind pushes it back, with this many times the stiffness of its inertia and
// this part of the stiffest spring of its cloth, within limits (StepParams::contactStiffness).
#define CONTACT_OVER_INERTIA 1024
#define CONTACT_OVER_SPRINGS 0.04

// The limits of friction follow what presses for so many Newton steps; in the others they stay. Limits that
// are given make friction the gradient of a potential, whose minimum Newton steps find (Li et al. 2020,
// "Incremental potential contact", take older ones throughout).
#define FRICTION_FOLLOWS 5u
// Slips that are slower meet less than all of friction [m/s]. With less than half of this, coarse sheets
// stuck half a degree above the critical angle (RowFabricOnASlope): in a step of 1/60 s, what they slip at
// that speed is within the tolerance.
#define SLOW_SLIP 0.01f
// What a step remembers of a contact that holds when it ends is the limit of its friction, or this where that
// is less [N]; of others 0. In the first Newton step of the next one, such a contact holds, and the limit is
// that: by the forces at the initial guess, which springs exaggerate, contacts of a sheet that turns with a
// ball let go.
#define LEAST_HELD 9.094947017729282379150390625e-13f  // 2^-40
// A particle is light for its friction where that is so many times as stiff as its inertia.
#define LIGHT 8.0f

// What becomes of a sum.
#define SUM_FIRST 0   // r.z at the start of conjugate gradients
#define SUM_STEP 1    // p.Hp: the length of a step along p
#define SUM_NEXT 2    // r.z: how much of the last direction is kept
#define SUM_LENGTH 3  // changes of energy: the length of the Newton step
#define SUM_UPDATE 4  // the largest update, and the largest displacement: whether the step is solved

// Squares that are larger, or NaN, count as this: a step with such updates is not solved [m^2].
#define LARGE_SQUARE 1152921504606846976.0f  // 2^60

#define STEP_ENDED 2u
// Of a linear system: its preconditioner, by rounding, or its exact Hessian is not positive, or r.z has risen
// to so many times what it began with. It is left as it is, and its Newton step does not count as the last
// one. Contacts of stiff sheets let r.z rise to 2^18 times and fall again; once it is rounding alone, it
// rises without end.
#define SYSTEM_LOST 2u
#define LOST_RISE 1048576.0f  // 2^20

// The Hessian of a Newton step. Projected, it lacks what compression takes from it, and is positive. But
// where cloth has buckled that is nearly all of it: updates are small long before the step is solved. After
// one of at most EXACT_BELOW tolerances, Newton steps take the exact Hessian. Where that is not positive,
// leads uphill or to a larger update, the rest of the step is projected. So is all of it where cloth touches
// something: there contacts change from one Newton step to the next, and the exact Hessian left more steps
// unsolved.
#define HESSIAN_PROJECTED 0u
#define HESSIAN_EXACT 1u
#define HESSIAN_REFUSED 2u  // projected until the step ends
#define EXACT_BELOW 4.0f

// A projected update that is so many times smaller than the tolerance ends a step: of cloth that touches
// nothing, and of cloth in contact.
#define TINY_UPDATE 64.0f
#define TINY_UPDATE_IN_CONTACT 8.0f

// When a pass does nothing any more.
#define GATE_NONE 0
#define GATE_STEP 1    // once the step is solved
#define GATE_SYSTEM 2  // once the linear system is

// A level of a piece and the next coarser one. Fine vertices are numbered from the first particle on, coarse
// ones from the first coarse vertex on.
struct LevelParams {
  uint fineFirst;  // vertex
  uint fineCount;
  uint coarseFirst;  // coarse vertex
  uint coarseCount;

  uint firstBlock;  // of the coarse level's matrix
  uint endBlock;
  uint unusedA;
  uint unusedB;
};

// A connected part of the coarsest level, whose matrix is inverted.
struct DensePart {
  uint first;  // coarse vertex
  uint count;
  uint firstEntry;  // of the matrix, column by column
  uint firstBlock;

  uint endBlock;
  uint unusedA;
  uint unusedB;
  uint unusedC;
};

// A level of a piece, and those that the last work group to restrict to it takes alone, finest first.
struct LevelsInARow {
  LevelParams levels[1 + LEVELS_ALONE];

  uint count;
  uint firstPart;  // of the coarsest level, if it is among these: [firstPart, endPart), else none
  uint endPart;
  uint unused;
};

// After so many Newton steps, linear systems of a step end at this part of the r.z that it may lack at its
// end. The first ones are solved as well as the tolerance says: most steps need no more. In scenes without
// contacts the second and third end at a smaller part; with contacts, friction would feel what they lack.
// Where cloth sways softly or folds, r.z sees a tenth of what is missing and less: without contacts, where
// smaller parts cost little, the later ones end at one, too. (A 64th takes hanging sheets a fifth to a half
// more iterations.)
#define THOROUGH_NEWTON_STEPS 3u
#define SUFFICIENT_RESIDUAL 0.25
#define SUFFICIENT_RESIDUAL_APART 0.0625
#define EARLY_RESIDUAL 0.00390625

// What conjugate gradients and the line search have come to.
SHARED_STRUCT ImplicitScalars {
  real residual;      // r.z
  real stepSize;      // alpha
  real kept;          // beta
  real newtonLength;  // 1/8 to 1

  real leastResidual;   // the r.z at which the linear system is solved
  real lastUpdate;      // of the step so far: largest update over largest displacement, or over the spacing
  uint isSystemSolved;  // or SYSTEM_LOST
  uint isStepSolved;    // STEP_ENDED: it is not, but nothing is done any more (of a round of contact)

  uint iterations;        // of the step so far,
  uint newtonSteps;       // the same
  uint groupsDone;        // work groups of the dispatch that is under way; 0 between dispatches
  uint secondOrderSteps;  // of all steps of `bdf2`, those that were no backward Euler

  // Of `bdf2`: how many steps before were solved, with the contacts of the step before them and nothing else
  // that moved particles; whether this one's contacts are other ones; whether something else moved particles.
  uint usualSteps;
  uint hasNewContacts;
  uint isDisturbed;
  uint pairs;  // of parts of the surface that may touch

  // Of all steps since the solver was made.
  uint steps;
  uint unconvergedSteps;  // that ended unsolved
  uint allIterations;
  uint allNewtonSteps;

  real sufficientResidual;  // r.z at which further linear systems of the step end [N m]
  uint hessian;             // of the Newton step, HESSIAN_PROJECTED and so on
  real updateBefore;        // the one before lastUpdate
  real mostResidual;        // r.z beyond which the linear system is lost
};

#ifdef __cplusplus
#undef SHARED_STRUCT
}  // namespace clothsim::shared
#endif
