// Planes for picking, as far as they can be seen; the floor that belongs to no collider is nothing.
#include "render/frame.glsl"
#include "render/plane_disc.glsl"

layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_NORMAL_LOCATION) in vec3 normal;
layout(location = INSTANCE_COLLIDER_LOCATION) in float collider;
layout(location = 0) out vec3 position;
layout(location = 1) out vec2 uv;
layout(location = 2) out vec2 fromCenter;
layout(location = 3) flat out uint identity;

void main() {
  vec2 corner = discCorner();
  position = onDisc(place, normal, corner);
  uv = vec2(0);
  fromCenter = corner;
  identity = collider < 0.0 ? PICK_NOTHING : PICK_COLLIDER | uint(collider) << PICK_KIND_BITS;
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
