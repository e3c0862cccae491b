// Capsules, boxes, tori and meshes for picking.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec3 ownPosition;
layout(location = INSTANCE_ROWS_LOCATION) in vec4 rowX;
layout(location = INSTANCE_ROWS_LOCATION + 1) in vec4 rowY;
layout(location = INSTANCE_ROWS_LOCATION + 2) in vec4 rowZ;
layout(location = INSTANCE_COLLIDER_LOCATION) in float collider;
layout(location = 0) out vec3 position;
layout(location = 1) out vec2 uv;
layout(location = 2) out vec2 fromCenter;
layout(location = 3) flat out uint identity;

void main() {
  vec4 p = vec4(ownPosition, 1.0);
  position = vec3(dot(rowX, p), dot(rowY, p), dot(rowZ, p));
  uv = vec2(0);
  fromCenter = vec2(0);
  identity = PICK_COLLIDER | uint(collider) << PICK_KIND_BITS;
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
