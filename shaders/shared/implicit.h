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
#define CORRECTIONS_BINDING 4
#define DIRECTIONS_BINDING 4
#define PRODUCTS_BINDING 4
#define CONTACT_PLANES_BINDING 4
#define PARTIAL_SUMS_BINDING 4
#define DISPLACEMENTS_BINDING 5
#define INCREMENTS_BINDING 5
#define ITERATES_BINDING 6
#define FACTORS_BINDING 6
#define AIR_BLOCKS_BINDING 7
#define BLOCKS_BINDING 7
#define SCALARS_BINDING 7

// Buffers read as texels, a vec4 a particle; the first four of them go on with the vertices of the coarse
// levels.
#define RESIDUALS_UNIT 25    // r = minus the gradient of the energy, later that of the linear system [N]
#define CORRECTIONS_UNIT 26  // z = preconditioned r [m]
#define FACTORS_UNIT 27      // two texels each: L D L^T of the diagonal block, l21 l31 l32 and 1/d1 1/d2 1/d3
#define BLOCKS_UNIT 28       // four texels each: what coarse diagonal blocks are made of
#define RIGHT_HAND_SIDES_UNIT \
  29  // b, and the diagonal a, of the energy 1/2 a |d|^2 - b.d of inertia, air and grabs
#define AIR_BLOCKS_UNIT 30     // two texels each: what the air adds to a, a symmetric matrix
#define DISPLACEMENTS_UNIT 31  // d, from the start of the step [m]
#define ITERATES_UNIT 32       // x + d, and the inverse mass
#define DIRECTIONS_UNIT 33     // p of conjugate gradients, and the inverse mass
#define PRODUCTS_UNIT 34       // H p; later a particle's change of energy at four lengths of the Newton step
#define INCREMENTS_UNIT 35     // the Newton step so far [m]
#define STARTS_UNIT 36         // x at the start of the step, and the inverse mass
#define PARTIAL_SUMS_UNIT 37
#define CUT_LINKS_UNIT 38       // an unsigned number a vertex: makeCutLinks() of src/solver/implicit.h
#define CONTACT_PLANES_UNIT 39  // two texels each: n and offset, carry and friction (cpu/collide.h)

// A bit for each neighbour of a vertex on its level, -1 to 1 columns and rows away.
#define LINK_BIT(columns, rows) (1u << (3 * (rows) + (columns) + 4))

// Sums over all particles have one order: lane t of 256 adds every 256th number of a block of 1024, the lanes
// are added as a tree, and so are the blocks.
#define SUM_LANES 256
#define SUM_BLOCK 1024u
// Passes over all particles take them in rows of so many.
#define PARTICLES_A_ROW 16384u

// Lengths of the Newton step that the line search looks at: 1, 1/2, 1/4, 1/8. It takes the first that lowers
// the energy by this part of what the slope promises (Armijo 1966).
#define LENGTHS_TRIED 4
#define SUFFICIENT_DECREASE 0x1p-13

// A plane that a particle is behind pushes it back, with this many times the stiffness of its inertia and
// what the stiffest spring of its cloth adds (StepParams::contactStiffness).
#define CONTACT_OVER_INERTIA 1024

// What becomes of a sum.
#define SUM_FIRST 0   // r.z at the start of conjugate gradients
#define SUM_STEP 1    // p.Hp: the length of a step along p
#define SUM_NEXT 2    // r.z: how much of the last direction is kept
#define SUM_LENGTH 3  // changes of energy: the length of the Newton step,
#define SUM_START 4   // and how much of the initial guess is taken

// A level of a grid and the next coarser one, of about half as many points in a direction (never fewer than
// 2).
SHARED_STRUCT LevelParams {
  uint fineFirst;  // vertex; the finest level's vertices are the particles
  uint fineColumns;
  uint fineRows;
  uint coarseFirst;

  uint coarseColumns;
  uint coarseRows;
  real stiffnessFactor;  // of the sum of stiffness over a coarse vertex' neighbourhood,
  real inertiaFactor;    // of the sum of inertia,

  real bending;  // and what bending adds to a coarse diagonal block [N/m]
  real unusedA;
  real unusedB;
  real unusedC;
};

// Kept between the passes of a Newton step.
SHARED_STRUCT ImplicitScalars {
  real residual;           // r.z
  real stepSize;           // alpha
  real kept;               // beta
  real predictedDecrease;  // how much the quadratic model falls along the Newton step, twice

  real newtonLength;  // 0 to 1
  real unusedX;
  real unusedY;
  real unusedZ;
};

#ifdef __cplusplus
#undef SHARED_STRUCT
}  // namespace clothsim::shared
#endif
