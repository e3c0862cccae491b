// Particles where they are while the shutter is open: as far along their velocities as frame.motion says.
#include "render/frame.glsl"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = MOTION_VELOCITIES_BINDING) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = SMOOTH_POINTS_BINDING) writeonly buffer Moved { vec4 moved[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(moved.length())) return;
  moved[i] = positions[i] + vec4(frame.motion * velocities[i].xyz, 0.0);
}
