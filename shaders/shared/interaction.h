// What an interaction does to the cloth in a step (src/solver/interaction.h), evaluated on the host and
// handed to both backends as the same bits. Included by GLSL (std140) and by C++, where `real` is float for
// the bitwise twin and double for tests of the physics. Rows of 16 bytes.
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

#define INTERACTION_PARAMS_BINDING 3  // uniform block
#define GRABBED_UNIT 16  // buffer read as texels, a texel a grabbed grid point: offset from the goal, weight
#define EXTERNAL_FORCES_UNIT 65  // a texel a particle [N]
#define CUT_MASKS_UNIT 17        // an unsigned number a particle: makeCutMasks() of src/cloth/cuts.h
#define FIRST_CUT_TRIANGLE 12    // the bit of the first incident triangle in a cut mask

// The springs, as bits of a cut mask, of which none may be cut for a line of three particles to bend: the
// line that ends at the particle from the left, has it in its middle, or begins at it to the right; and the
// same along the column.
#define BENDING_LEFT 0x10u
#define BENDING_ROW 0x41u
#define BENDING_RIGHT 0x80u
#define BENDING_UPPER 0x20u
#define BENDING_COLUMN 0x202u
#define BENDING_LOWER 0x800u

SHARED_STRUCT InteractionParams {
  real goalX;  // where the grab is at the end of the step [m]
  real goalY;
  real goalZ;
  real velocityKept;  // A of v_new = A v' + B (goal - x) + push

  real pushX;  // what the grab's own velocity adds [m/s]
  real pushY;
  real pushZ;
  real pull;  // B [1/s]

  uint firstColumn;  // the block of grid points that is grabbed
  uint firstRow;
  uint columns;
  uint rows;

  real largestSpeed;         // to which a grab pulls [m/s],
  real largestSpeedSquared;  // squared
  real inverseRadius;        // of the jet [1/m]
  real inverseRadiusSquared;

  real originX;  // of the jet [m]
  real originY;
  real originZ;
  real jetSpeed;  // on its axis [m/s]

  real directionX;  // of the jet, a unit vector
  real directionY;
  real directionZ;
  uint jetAlone;  // whether the air rests but for the jet, and acts in it alone

  // Of `implicit`: the grab is a spring of the stiffness resistance m / h^2 to the place that is
  // reach (B (goal - x) + push) from x.
  real resistance;           // 2 h w + h^2 w^2
  real reach;                // h (1 + resistance) / resistance [s]
  real largestDisplacement;  // h largestSpeed [m],
  real largestDisplacementSquared;
};

#ifdef __cplusplus
#undef SHARED_STRUCT
}  // namespace clothsim::shared
#endif
