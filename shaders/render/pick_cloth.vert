// Cloth for picking. The number is that of a corner of the triangle, which tells the grid.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec4 particle;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 textureCoordinate;
layout(location = 0) out vec3 position;
layout(location = 1) out vec2 uv;
layout(location = 2) out vec2 fromCenter;
layout(location = 3) flat out uint identity;

void main() {
  position = particle.xyz;
  uv = textureCoordinate;
  fromCenter = vec2(0);
  identity = PICK_CLOTH | uint(gl_VertexID) << PICK_KIND_BITS;
  gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
