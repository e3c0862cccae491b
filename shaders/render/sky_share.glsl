// Which share of the sky's light a matte surface gets in an exposure of a mean: that of a few directions out of all, each as
// likely, so that the mean over the exposures is 1 where nothing is in the way. 1 in pictures that are one exposure.
#include "render/frame.glsl"

layout(binding = SKY_SHADOW_UNIT) uniform sampler2DShadow skyShadow[SKY_DIRECTIONS];

const float SKY_OFFSET_TEXELS = 2.0;  // off the surface, against its own shadow
const float SKY_TAP_TEXELS = 2.0;     // so soft that no single direction's shadow shows an edge

float skyShareFrom(int k, vec3 position, vec3 normal) {
  float facing = dot(normal, frame.toSky[k].xyz);
  if (facing <= 0.0) return 0.0;
  float offset = frame.toSky[k].w * SKY_OFFSET_TEXELS * (0.35 + sqrt(1.0 - min(facing * facing, 1.0)));
  vec3 place = (frame.skyShadowFromWorld[k] * vec4(position + offset * normal, 1.0)).xyz;
  place.z = min(place.z, 1.0);
  vec2 tap = SKY_TAP_TEXELS / vec2(textureSize(skyShadow[k], 0));
  float sum = texture(skyShadow[k], place + vec3(tap.x, 0.0, 0.0)) + texture(skyShadow[k], place - vec3(tap.x, 0.0, 0.0));
  sum += texture(skyShadow[k], place + vec3(0.0, tap.y, 0.0)) + texture(skyShadow[k], place - vec3(0.0, tap.y, 0.0));
  return facing * sum;
}

float skyShare(vec3 position, vec3 normal) {
  if (!isExposure()) return 1.0;
  float sum = 0.0;
  for (int k = 0; k < SKY_DIRECTIONS; ++k) sum += skyShareFrom(k, position, normal);
  return sum / float(SKY_DIRECTIONS);
}

// What shades a hollow: the exposures see it for themselves.
float openness(float guessed) { return isExposure() ? 1.0 : guessed; }
