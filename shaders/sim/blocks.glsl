// What every pass of the simulation sees: the parameters of the step, the state at its start and at its end.
#include "shared/interaction.h"
#include "shared/step_params.h"

layout(local_size_x = WORK_GROUP_COLUMNS, local_size_y = WORK_GROUP_ROWS) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };

// Particle state lies in storage buffers, xyz and the inverse mass in w. Passes write through storage blocks and read the
// same buffers as texels.
layout(std430, binding = NEW_POSITIONS_BINDING) writeonly buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) writeonly buffer NewVelocities { vec4 newVelocities[]; };
layout(std430, binding = FORCES_BINDING) buffer Forces { vec4 forces[]; };
layout(binding = NEW_POSITIONS_UNIT) uniform samplerBuffer positionsSoFar;
layout(binding = NEW_VELOCITIES_UNIT) uniform samplerBuffer velocitiesSoFar;
layout(binding = REST_LENGTHS_UNIT) uniform samplerBuffer restLengths;
layout(binding = COLLIDERS_UNIT) uniform samplerBuffer colliderRows;
layout(binding = PIN_STARTS_UNIT) uniform samplerBuffer pinStarts;
layout(binding = PIN_MOTIONS_UNIT) uniform samplerBuffer pinMotionRows;
layout(binding = DISTANCES_UNIT) uniform samplerBuffer distances;

layout(binding = CUT_MASKS_UNIT) uniform usamplerBuffer cutMasks;

// The state at the start comes the way that the device is faster at.
#if LOADS_FROM_STORAGE
layout(std430, binding = POSITIONS_BINDING) readonly restrict buffer Positions { vec4 positions[]; };
layout(std430, binding = VELOCITIES_BINDING) readonly restrict buffer Velocities { vec4 velocities[]; };
vec4 positionAt(uint i) { return positions[i]; }
vec3 velocityAt(uint i) { return velocities[i].xyz; }
#else
layout(binding = POSITIONS_UNIT) uniform samplerBuffer positions;
layout(binding = VELOCITIES_UNIT) uniform samplerBuffer velocities;
vec4 positionAt(uint i) { return texelFetch(positions, int(i)); }
vec3 velocityAt(uint i) { return texelFetch(velocities, int(i)).xyz; }
#endif

// Known when the pass is compiled, so that what a scene lacks costs nothing (src/solver/gpu/pass_programs.cpp).
const bool hasWind = HAS_WIND != 0;
const uint particleForces = ACTIVE_FORCES;  // bit FORCE_... is set when the force acts
const bool hasMaterial = HAS_MATERIAL != 0;
const uint colliderTypes = COLLIDER_TYPES;  // bit COLLIDER_... is set when the scene has such colliders
const bool hasColliders = colliderTypes != 0u;
const bool hasCoulombFriction = HAS_COULOMB_FRICTION != 0;
const bool hasMovingColliders = HAS_MOVING_COLLIDERS != 0;
const bool hasMovingPins = HAS_MOVING_PINS != 0;
const bool hasCuts = HAS_CUTS != 0;
const bool hasGrab = HAS_GRAB != 0;
const bool hasJet = HAS_JET != 0;
const bool hasExternalForces = HAS_EXTERNAL_FORCES != 0;
const bool hasRestLengthTable = HAS_REST_LENGTH_TABLE != 0;
const uint enabledSlots = ENABLED_SLOTS;  // bit `slot` is set when its springs are enabled

// Which of a particle's springs and triangles are gone (src/cloth/cuts.h).
uint cutMaskOf(uint i) { return hasCuts ? texelFetch(cutMasks, int(i)).x : 0u; }
bool isIntact(uint cutMask, uint bit) { return !hasCuts || (cutMask >> bit & 1u) == 0u; }

// One invocation a grid point.
struct GridPoint {
  uint column;
  uint row;
  uint index;  // into the particle buffers
  bool exists;
};

// That of a particle of this grid.
GridPoint pointOf(uint i) {
  uint place = i - step.firstParticle;
  return GridPoint(place % step.columns, place / step.columns, i, true);
}

GridPoint thisGridPoint() {
  uvec2 point = gl_GlobalInvocationID.xy;
  bool exists = point.x < step.columns && point.y < step.rows;
  return GridPoint(point.x, point.y, step.firstParticle + point.y * step.columns + point.x, exists);
}
