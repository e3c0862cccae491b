// The sky's light on a matte surface (src/render/environment.h).
#include "render/frame.glsl"

vec3 skyIrradiance(vec3 n) {
  vec3 light = frame.irradiance[0].rgb + n.x * frame.irradiance[1].rgb + n.y * frame.irradiance[2].rgb + n.z * frame.irradiance[3].rgb;
  light += n.x * n.y * frame.irradiance[4].rgb + n.y * n.z * frame.irradiance[5].rgb + n.z * n.x * frame.irradiance[6].rgb;
  light += n.z * n.z * frame.irradiance[7].rgb + (n.x * n.x - n.y * n.y) * frame.irradiance[8].rgb;
  return max(light, 0.0);
}
