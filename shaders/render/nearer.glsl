// What is drawn on a surface must lie before it: moved towards the eye by a small part of the way.
#include "render/frame.glsl"

const float NEARER = 0.004;

vec4 clipPlaceNearer(vec3 position) {
  return frame.clipFromWorld * vec4(mix(position, frame.eye.xyz, NEARER), 1.0);
}
