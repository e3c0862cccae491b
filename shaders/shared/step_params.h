// Everything a step needs besides the state, evaluated on the host and handed to both backends as the same
// bits. Included by GLSL (std140 block, std430 array) and by C++, where `real` is float for the bitwise twin
// and double for tests of the physics. Rows of 16 bytes; a test compares the layout with the driver's own
// reflection.
#ifdef __cplusplus
#pragma once
#include <cstdint>
namespace clothsim::shared {
using uint = std::uint32_t;
#define SHARED_STRUCT   \
  template <class real> \
  struct
#define ROWS_OF(Row) Row<real>
#else
#define SHARED_STRUCT struct
#define ROWS_OF(Row) Row
#define real float
#endif

#define STEP_PARAMS_BINDING 0  // uniform block
#define LIMIT_COLOR_BINDING 1  // uniform block

#define NEW_POSITIONS_BINDING 0  // storage blocks: at the end of the step,
#define NEW_VELOCITIES_BINDING 1
#define FORCES_BINDING 2     // between separate passes
#define WATCH_BINDING 3      // the watchdog's row of this step
#define POSITIONS_BINDING 8  // at the start of the step, where it is not read as texels
#define VELOCITIES_BINDING 9

#define POSITIONS_UNIT 0  // the particle buffers as texels: at the start of the step,
#define VELOCITIES_UNIT 1
#define NEW_POSITIONS_UNIT 2  // at its end,
#define NEW_VELOCITIES_UNIT 3
#define REST_LENGTHS_UNIT 4  // slot-major: slot * total particles + owner

#define COLLIDERS_UNIT 5  // COLLIDER_ROWS texels each
#define DISTANCES_UNIT 8  // samples of the signed distance grids of all mesh colliders

// The watchdog (src/solver/divergence.h). A row has an entry a pass: 4 * particle + reason, the lowest that
// came up. The numbers are the order of the passes in a step: the first one that has an entry is where it
// began.
#define PASS_START 0u  // the state that a step began with, when it was handed in from outside
#define PASS_KICK 1u   // the conversion of velocities to another integrator
#define PASS_FORCES 2u
#define PASS_INTEGRATE 3u
#define PASS_EARLY_LIMIT 4u  // the strain limit where it comes before contacts: robust self-collision
#define PASS_COLLIDE 5u
#define PASS_LIMIT 6u
#define PASSES 7
#define REASON_NON_FINITE 0u
#define REASON_RUNAWAY_SPEED 1u
#define REASON_RUNAWAY_STRAIN 2u
#define NO_DIVERGENCE 0xffffffffu
#define LIMIT_TILE 24  // grid points across and along that a work group of sim/limit_tile.comp stores
#define LIMIT_HALO \
  10  // and how far about them it looks: two colours for each slot, as far as its springs reach
#define LINES_AT_ONCE 8u  // of springs, by one invocation of sim/limit_slot.comp
#define WATCHED_ROWS 8u   // of the grid, by one invocation of sim/watch_limit.comp

#define PIN_STARTS_UNIT 6   // a texel a particle: start position, and the number of its path + 1 (0: none)
#define PIN_MOTIONS_UNIT 7  // PIN_MOTION_ROWS texels each

#define PIN_MOTION_ROWS 5
#define COLLIDER_ROWS 14
#define COLLIDER_SWEEP_ROW 3   // read for spheres only
#define COLLIDER_AXES_ROW 4    // read for shapes that have a frame of their own
#define COLLIDER_GRID_ROW 7    // read for meshes
#define COLLIDER_MOTION_ROW 9  // read where some collider moves
#define COLLIDER_WAY_ROW 13    // read where some body deforms
#define SWEEP_STEPS 8          // of the search for the place where a particle entered a shape

// The springs of one slot (cloth/cloth.h).
SHARED_STRUCT SpringParams {
  real stiffness;         // [N/m]
  real restLength;        // nominal [m]
  real limitLength;       // limitFactor restLength [m]
  real maxLengthSquared;  // ((1 + max_strain) restLength)^2, for the watchdog [m^2]
};

#define MOST_ATTRACTORS 16
SHARED_STRUCT AttractorParams {
  real x;  // [m]
  real y;
  real z;
  real pull;  // acceleration towards it in a unit of distance, at its place [1/s^2]

  real inverseRadiusSquared;  // [1/m^2]
  real unusedA;
  real unusedB;
  real unusedC;
};

#define MOST_SEAMS 32
SHARED_STRUCT SeamParams {
  real lengthFactor;  // of a rest length over that at the start
  real unusedA;
  real unusedB;
  real unusedC;
};

SHARED_STRUCT StepParams {
  uint firstParticle;
  uint columns;
  uint rows;
  uint totalParticles;  // of all pieces

  uint useRestLengthTable;
  uint hasWind;
  uint colliderCount;
  uint firstCollider;  // of this step, in the collider array

  real timeStep;         // h [s]
  real inverseTimeStep;  // 1 / h
  real velocityKept;     // what a step keeps of a velocity: 1 - damping / 100, of a material exp(-damping h)
  real airResistance;    // a of -a |v| v [kg/m]

  real gravityX;  // [m/s^2]
  real gravityY;
  real gravityZ;
  real limitFactor;  // 1 + strain limit; of `implicit`, where the second spring begins

  real airVelocityX;  // wind and gust now [m/s]
  real airVelocityY;
  real airVelocityZ;
  real kickTime;  // +-h/2: turns v(n-1/2) into v(n) and back [s]

  real dragFactor;       // rho_a C_d / 12 [kg/m^3]
  real liftFactor;       // rho_a C_l / 12 [kg/m^3]
  real planeOffset;      // how far off a plane a particle is put back [m]
  real maxSpeedSquared;  // for the watchdog [m^2/s^2]

  uint enabledSlots;    // bit `slot` is set when its springs are enabled
  uint piece;           // which of the cloth's
  uint limitPass;       // PASS_LIMIT or PASS_EARLY_LIMIT
  uint firstPinMotion;  // of this step, in the array of pin motions

  uint hasMaterial;      // springs on a border count half, and bending is one of second differences
  real bendAlongRow;     // b of the energy 1/2 b |x(i-1) - 2 x(i) + x(i+1)|^2 [N/m]
  real bendAlongColumn;  // [N/m]
  real limitStiffness;   // of `implicit`: what a spring longer than limitLength adds to it [N/m]

  // Of `implicit`, for a particle of mass m: the energy 1/2 m inertia |d - guess|^2 of its displacement d in
  // the step,
  real inertia;           // (1 + c h) / h^2, c the rate of damping [1/s^2]
  real guessTime;         // guess = guessTime (v + h g), h / (1 + c h) [s]
  real leastMotion;       // a step's update is compared with its motion, at least with this [m]
  real contactStiffness;  // what a collider's surface has beside CONTACT_OVER_INERTIA (shared/implicit.h)
                          // [N/m]

  uint isMesh;          // springs, bending and triangles come from lists (shared/mesh_lists.h)
  real maxStretch;      // 1 + max_strain, for the watchdog
  uint particleForces;  // those that act, a bit a FORCE_... of shared/forces.h
  uint attractorCount;

  // Of `implicit`: a step is solved when its last update is at most this part of the motion,
  real tolerance;
  real systemTolerance;     // and a linear system when r.z is this part of what it began with;
  real toleratedStiffness;  // in the last update r.z over the squared motion may be this, too [N/m]
  uint hasSurface;          // cloth touches itself inside the step (src/solver/surface.h)

  // Of `bdf2`, in place of inertia and guessTime, with 2 h / 3 for h; 0 under `implicit`.
  real secondInertia;
  real secondGuessTime;
  real secondTime;  // 2 h / 3 [s]
  real secondRate;  // 1 / secondTime

  real pressureFactor;  // p / 6, below 0 where the front is against the order of the triangles' corners [Pa]
  real unusedA;
  real unusedB;
  real unusedC;

  ROWS_OF(SpringParams) springs[6];
  ROWS_OF(AttractorParams) attractors[MOST_ATTRACTORS];
  ROWS_OF(SeamParams) seams[MOST_SEAMS];
};

SHARED_STRUCT ColliderParams {
  real pointX;  // the shape's origin or plane's point at the end of the step [m]
  real pointY;
  real pointZ;
  real radius;  // this and the sizes mean what the shape's law says (shared/shapes/) [m]

  real normalX;  // of the plane
  real normalY;
  real normalZ;
  real radiusSquared;

  uint type;
  uint moving;
  uint coulomb;  // whether friction follows Coulomb's law, CS184's otherwise
  real friction;

  real sweepSquared;   // a sphere looks for an entry when a way is longer [m^2],
  real grazeSquared;   // and ignores passages farther than this from its centre [m^2]
  real inverseRadius;  // of the sphere [1/m]
  uint unusedSweep;

  // The shape's own axes in the world, at the end of the step: the rows of the rotation from the world.
  real axisXX;
  real axisXY;
  real axisXZ;
  real sizeX;

  real axisYX;
  real axisYY;
  real axisYZ;
  real sizeY;

  real axisZX;
  real axisZY;
  real axisZZ;
  real sizeZ;

  // The signed distance grid of a mesh: place of its first sample in the own frame, samples along x, y and z.
  real gridX;
  real gridY;
  real gridZ;
  real inverseCell;  // [1/m]

  uint gridColumns;
  uint gridRows;
  uint gridLayers;
  uint firstSample;  // among those of all meshes; of a body that deforms, of the shape that it comes from

  // The rigid motion over the step: x + (rotation (x - pivot) + translation), where `rotation` lacks the
  // identity.
  real rotationXX;
  real rotationXY;
  real rotationXZ;
  real translationX;

  real rotationYX;
  real rotationYY;
  real rotationYZ;
  real translationY;

  real rotationZX;
  real rotationZY;
  real rotationZZ;
  real translationZ;

  real pivotX;  // the shape's origin or plane's point at the start of the step
  real pivotY;
  real pivotZ;
  uint nextSample;  // of a body that deforms: as firstSample, for the shape that it goes to

  // Of a body that deforms: how much of the way to the next shape is done at the end of the step, how much of
  // a way it goes in the step, and the first displacements of the way that it is on at the end and in the
  // middle of the step. Both 0 for what is rigid.
  real part;
  real share;
  uint way;
  uint middleWay;
};

// The rigid motion of pins from the start of the simulation to the end of the step: x + (rotation (x - pivot)
// + translation), where `rotation` lacks the identity. Pins that have not left their place are there to the
// bit.
SHARED_STRUCT PinMotionParams {
  real rotationXX;
  real rotationXY;
  real rotationXZ;
  real translationX;  // [m]

  real rotationYX;
  real rotationYY;
  real rotationYZ;
  real translationY;

  real rotationZX;
  real rotationZY;
  real rotationZZ;
  real translationZ;

  real pivotX;  // mean of the start positions [m]
  real pivotY;
  real pivotZ;
  // Of pins that are held for a while (pin_paths.h): the part of the way to their path that they go in the
  // step, but no farther than `reach` [m]. 0: all of it, to the bit.
  real follow;

  real reach;
  real reachSquared;
  real unusedA;
  real unusedB;
};

// One colour of the strain limit: springs of one slot of which no two share a particle. The owners are at
// column first + step (i / run) + i % run below end, and likewise in rows. Of a mesh: springs firstColumn to
// endColumn in the order of their numbers.
struct LimitColor {
  uint slot;
  uint unusedA;
  uint unusedB;
  uint unusedC;

  uint firstColumn;
  uint columnStep;
  uint columnRun;
  uint endColumn;

  uint firstRow;
  uint rowStep;
  uint rowRun;
  uint endRow;
};

#ifdef __cplusplus
#undef SHARED_STRUCT
#undef ROWS_OF
}  // namespace clothsim::shared
#endif
