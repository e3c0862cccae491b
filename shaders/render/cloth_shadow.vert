// Cloth into the shadow map.
#include "render/frame.glsl"
#include "render/cloth_point.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;

void main() {
  vec3 point = drawnPoint(position.xyz, normal.xyz, uv);
  gl_Position = vec4((frame.shadowFromWorld * vec4(point, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
