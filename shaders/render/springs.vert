// Ends of springs.
#include "render/nearer.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = LINE_LOOK_LOCATION) in vec4 look;
layout(location = 0) out vec4 lookOut;

void main() {
  lookOut = look;
  gl_Position = clipPlaceNearer(position.xyz);
}
