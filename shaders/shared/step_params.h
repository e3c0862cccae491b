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
#define SPRING_ROWS(Row) Row<real>
#else
#define SHARED_STRUCT struct
#define SPRING_ROWS(Row) Row
#define real float
#endif

#define STEP_PARAMS_BINDING 0  // uniform block
#define LIMIT_COLOR_BINDING 1  // uniform block

#define NEW_POSITIONS_BINDING 0  // storage blocks: at the end of the step,
#define NEW_VELOCITIES_BINDING 1
#define FORCES_BINDING 2  // between separate passes

#define POSITIONS_UNIT 0  // the particle buffers as texels: at the start of the step,
#define VELOCITIES_UNIT 1
#define NEW_POSITIONS_UNIT 2  // at its end,
#define NEW_VELOCITIES_UNIT 3
#define REST_LENGTHS_UNIT 4  // slot-major: slot * total particles + owner

#define COLLIDERS_UNIT 5  // COLLIDER_ROWS texels each

#define COLLIDER_ROWS 7
#define COLLIDER_SPHERE 0u
#define COLLIDER_PLANE 1u

// The springs of one slot (cloth/cloth.h).
SHARED_STRUCT SpringParams {
  real stiffness;    // [N/m]
  real restLength;   // nominal [m]
  real limitLength;  // (1 + strain limit) restLength [m]
  uint enabled;
};

SHARED_STRUCT StepParams {
  uint firstParticle;
  uint columns;
  uint rows;
  uint totalParticles;  // of all grids

  uint useRestLengthTable;
  uint hasWind;
  uint colliderCount;
  uint firstCollider;  // of this step, in the collider array

  real timeStep;         // h [s]
  real inverseTimeStep;  // 1 / h
  real velocityKept;     // 1 - damping / 100, of a step
  real airResistance;    // a of -a |v| v [kg/m]

  real gravityX;  // [m/s^2]
  real gravityY;
  real gravityZ;
  real limitFactor;  // 1 + strain limit

  real airVelocityX;  // wind and gust now [m/s]
  real airVelocityY;
  real airVelocityZ;
  real kickTime;  // +-h/2: turns v(n-1/2) into v(n) and back [s]

  real dragFactor;   // rho_a C_d / 12 [kg/m^3]
  real liftFactor;   // rho_a C_l / 12 [kg/m^3]
  real planeOffset;  // how far off a plane a particle is put back [m]
  real unusedReal;

  SPRING_ROWS(SpringParams) springs[6];
};

SHARED_STRUCT ColliderParams {
  real pointX;  // sphere's centre or plane's point at the end of the step [m]
  real pointY;
  real pointZ;
  real radius;  // [m]

  real normalX;  // plane
  real normalY;
  real normalZ;
  real radiusSquared;

  uint type;
  uint moving;
  real motionKept;  // 1 - friction
  real unusedReal;

  // The rigid motion over the step: x + (turn (x - pivot) + shift), where turn is the rotation minus the
  // identity.
  real turnXX;
  real turnXY;
  real turnXZ;
  real shiftX;

  real turnYX;
  real turnYY;
  real turnYZ;
  real shiftY;

  real turnZX;
  real turnZY;
  real turnZZ;
  real shiftZ;

  real pivotX;  // sphere's centre or plane's point at the start of the step
  real pivotY;
  real pivotZ;
  real unusedPivot;
};

// One colour of the strain limit: springs of one slot of which no two share a particle. The owners are at
// column first + step (i / run) + i % run below end, and likewise in rows.
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
#undef SPRING_ROWS
}  // namespace clothsim::shared
#endif
