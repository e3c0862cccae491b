// Pinned particles, those whose inverse mass is 0; others are thrown out of the picture.
#include "render/nearer.glsl"

layout(location = POSITION_LOCATION) in vec4 particle;

const float DIAMETER = 0.013;  // of the picture's height

void main() {
  gl_PointSize = max(6.0, DIAMETER * frame.pixels.y);
  gl_Position = particle.w == 0.0 ? clipPlaceNearer(particle.xyz) : vec4(2.0, 2.0, 2.0, 1.0);
}
