// Planes and the floor: a square around the stage; its fragments fade out towards a circle. Its light is the same
// everywhere but for the shadow, so it is computed here.
#include "render/lights.glsl"
#include "render/plane_disc.glsl"

layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;
layout(location = INSTANCE_NORMAL_LOCATION) in vec3 normal;
layout(location = 0) out vec2 fromCenter;  // 1 at the circle
layout(location = 1) out vec2 shadowPlace;
layout(location = 2) flat out vec3 keyLight;      // of the front
layout(location = 3) flat out vec3 shadeLight;    // of the front, without the key light
layout(location = 4) flat out vec3 behindLight;

void main() {
  vec2 corner = discCorner();
  vec3 position = onDisc(place, normal, corner);
  fromCenter = corner;
  shadowPlace = (frame.shadowFromWorld * vec4(position, 1.0)).xy;
  shadeLight = frame.floorColor.rgb * diffuseLight(normal, 0.0);
  keyLight = frame.floorColor.rgb * diffuseLight(normal, 1.0) - shadeLight;
  behindLight = frame.floorColor.rgb * diffuseLight(-normal, 1.0);
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
