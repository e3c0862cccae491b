// What every pass of the simulation sees: the parameters of the step, the state at its start and at its end.
#include "shared/step_params.h"

layout(local_size_x = WORK_GROUP_COLUMNS, local_size_y = WORK_GROUP_ROWS) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };

layout(std430, binding = POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };    // w: inverse mass
layout(std430, binding = VELOCITIES_BINDING) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = NEW_POSITIONS_BINDING) buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) buffer NewVelocities { vec4 newVelocities[]; };
layout(std430, binding = FORCES_BINDING) buffer Forces { vec4 forces[]; };
layout(std430, binding = COLLIDERS_BINDING) readonly buffer Colliders { ColliderParams colliders[]; };
layout(std430, binding = REST_LENGTHS_BINDING) readonly buffer RestLengths { float restLengths[]; };

// One invocation a grid point.
struct GridPoint {
  uint column;
  uint row;
  uint index;  // into the particle buffers
  bool exists;
};

GridPoint thisGridPoint() {
  uvec2 point = gl_GlobalInvocationID.xy;
  bool exists = point.x < step.columns && point.y < step.rows;
  return GridPoint(point.x, point.y, step.firstParticle + point.y * step.columns + point.x, exists);
}
