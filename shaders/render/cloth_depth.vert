// Cloth's depth alone, ahead of its shading, so that hidden layers are not shaded.
#include "render/frame.glsl"
#include "render/cloth_point.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;
invariant gl_Position;

void main() {
  vec3 point = drawnPoint(position.xyz, normal, uv);
  gl_Position = frame.clipFromWorld * vec4(point, 1.0);
}
