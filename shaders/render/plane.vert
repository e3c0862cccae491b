// Planes and the ground: a square around the stage. Its light is the same everywhere but for the pool and the shadow, so it is
// computed here, without the surface's colour.
#include "render/lights.glsl"
#include "render/plane_disc.glsl"

layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_NORMAL_LOCATION) in vec3 normal;
layout(location = INSTANCE_LOOK_LOCATION) in vec4 instanceLook;
layout(location = 0) out vec2 fromCenter;  // 1 at the circle
layout(location = 1) out vec3 shadowPlace;
layout(location = 2) flat out vec3 keyLight;   // of the front
layout(location = 3) flat out vec3 wideLight;  // of the fill light and the sky
layout(location = 4) flat out vec3 behindLight;
layout(location = 6) out vec3 planePosition;
layout(location = 7) flat out vec3 planeNormal;
layout(location = 8) flat out vec4 look;

void main() {
  look = instanceLook;
  vec2 corner = discCorner();
  vec3 position = onDisc(place, normal, corner);
  fromCenter = corner;
  shadowPlace = (frame.shadowFromWorld * vec4(position, 1.0)).xyz;
  planePosition = position;
  planeNormal = normal;
  wideLight = diffuseLight(normal, 0.0, 1.0);
  keyLight = diffuseLight(normal, 1.0, 0.0);
  behindLight = diffuseLight(-normal, 1.0, 1.0);
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
