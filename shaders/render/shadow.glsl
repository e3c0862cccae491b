// How much of the key light reaches a place: percentage-closer filtering with bilinear comparisons.
#include "render/frame.glsl"
#ifdef WINDOW
#include "render/window.glsl"
#endif

layout(binding = SHADOW_MAP_UNIT) uniform sampler2DShadow shadowMap;

const float TAP_SPACING = 2.0;  // [texels]; bilinear taps two texels apart leave no gap
const float EXPOSED_SPACING = 5.0;  // of an exposure, whose shadow is one of many side by side

// By a single bilinear comparison.
float sunlitOnce(vec3 place) {
  float lit = texture(shadowMap, vec3(place.xy, min(place.z, 1.0)));
#ifdef WINDOW
  lit *= windowLight(place.xy);
#endif
  return lit;
}

float sunlit(vec3 place) {
  vec2 texel = 0.5 * (isExposure() ? EXPOSED_SPACING : TAP_SPACING) / vec2(textureSize(shadowMap, 0));
  vec3 inside = vec3(place.xy, min(place.z, 1.0));
  float sum = texture(shadowMap, inside + vec3(-texel.x, -texel.y, 0));
  sum += texture(shadowMap, inside + vec3(texel.x, -texel.y, 0));
  sum += texture(shadowMap, inside + vec3(-texel.x, texel.y, 0));
  sum += texture(shadowMap, inside + vec3(texel.x, texel.y, 0));
#ifdef WINDOW
  sum *= windowLight(place.xy);
#endif
  return 0.25 * sum;
}
