// A tile of the picture as a point.
#include "render/frame.glsl"

layout(location = POSITION_LOCATION) in vec2 middle;  // [pixels]

void main() {
  gl_PointSize = EDGE_TILE;
  gl_Position = vec4(middle * frame.pixels.zw * 2.0 - 1.0, 0.0, 1.0);
}
