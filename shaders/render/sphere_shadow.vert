// Spheres into the shadow map.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec3 unitPosition;
layout(location = INSTANCE_PLACE_LOCATION) in vec4 place;

void main() {
  vec3 position = place.xyz + place.w * unitPosition;
  gl_Position = vec4((frame.shadowFromWorld * vec4(position, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
