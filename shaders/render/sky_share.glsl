// Which share of the sky's light a matte surface gets in an exposure of a mean: that of one direction out of all, each as
// likely, so that the mean over the exposures is 1 where nothing is in the way. 1 in pictures that are one exposure.
#include "render/frame.glsl"
#include "render/tone.glsl"

layout(binding = SKY_SHADOW_UNIT) uniform sampler2DShadow skyShadow;

const float SKY_OFFSET_TEXELS = 3.0;  // off the surface, against its own shadow
const float SKY_TAP_TEXELS = 7.0;     // so soft that no single exposure's shadow shows an edge

float skyShare(vec3 position, vec3 normal) {
  if (!isExposure()) return 1.0;
  float facing = dot(normal, frame.toSky.xyz);
  if (facing <= 0.0) return 0.0;
  float offset = frame.toSky.w * SKY_OFFSET_TEXELS * (0.35 + sqrt(1.0 - min(facing * facing, 1.0)));
  vec3 place = (frame.skyShadowFromWorld * vec4(position + offset * normal, 1.0)).xyz;
  place.z = min(place.z, 1.0);
  vec2 tap = SKY_TAP_TEXELS / vec2(textureSize(skyShadow, 0));
  float sum = texture(skyShadow, place);
  for (int i = 0; i < 4; ++i)
    sum += texture(skyShadow, place + vec3(tap * vec2(i < 2 ? 1.0 : -1.0, (i & 1) == 0 ? 0.4 : -0.4).xy, 0.0));
  for (int i = 0; i < 4; ++i)
    sum += texture(skyShadow, place + vec3(tap * vec2((i & 1) == 0 ? 0.4 : -0.4, i < 2 ? 1.0 : -1.0).xy, 0.0));
  return 4.0 * facing * sum / 9.0;
}

// What shades a hollow: the exposures see it for themselves.
float openness(float guessed) { return isExposure() ? 1.0 : guessed; }
