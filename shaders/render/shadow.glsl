// How much of the key light reaches a place: percentage-closer filtering with bilinear comparisons.
#include "render/frame.glsl"

layout(binding = SHADOW_MAP_UNIT) uniform sampler2DShadow shadowMap;

const float TAP_SPACING = 2.0;  // [texels]; bilinear taps two texels apart leave no gap

float sunlit(vec3 place) {
  if (any(lessThan(place.xy, vec2(0))) || any(greaterThan(place.xy, vec2(1)))) return 1.0;
  vec2 texel = TAP_SPACING / vec2(textureSize(shadowMap, 0));
  vec3 shifted = vec3(place.xy, min(place.z, 1.0));
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) sum += texture(shadowMap, shifted + vec3(vec2(x, y) * texel, 0.0));
  }
  return sum / 9.0;
}
