// Spheres for picking.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec3 unitPosition;
layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_COLLIDER_LOCATION) in float collider;
layout(location = 0) out vec3 position;
layout(location = 1) out vec2 uv;
layout(location = 2) out vec2 fromCenter;
layout(location = 3) flat out uint identity;

void main() {
  position = place.xyz + place.w * unitPosition;
  uv = vec2(0);
  fromCenter = vec2(0);
  identity = PICK_COLLIDER | uint(collider) << PICK_KIND_BITS;
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
