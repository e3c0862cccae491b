// Pinned particles, those whose inverse mass is 0; others are thrown out of the picture.
#include "render/nearer.glsl"

layout(location = POSITION_LOCATION) in vec4 particle;
layout(location = LINE_LOOK_LOCATION) in vec4 look;  // w: size of a mark, 1 where there are few

const float DIAMETER = 0.013;  // of the picture's height

void main() {
  gl_PointSize = look.w * max(6.0, DIAMETER * frame.pixels.y);
  gl_Position = particle.w == 0.0 ? clipPlaceNearer(particle.xyz) : vec4(2.0, 2.0, 2.0, 1.0);
}
