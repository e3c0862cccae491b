// Cloth into the shadow map.
#include "render/frame.glsl"
#include "render/cloth_point.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;

void main() {
  // Depth grows away from the light.
  vec3 toLight = -normalize(vec3(frame.shadowFromWorld[0].z, frame.shadowFromWorld[1].z, frame.shadowFromWorld[2].z));
  vec3 point = castingPoint(position.xyz, normal, uv, toLight);
  gl_Position = vec4((frame.shadowFromWorld * vec4(point, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
