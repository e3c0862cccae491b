// Cloth into the shadow map.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec4 position;

void main() {
  gl_Position = vec4((frame.shadowFromWorld * vec4(position.xyz, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
