// Averages a pixel's samples in linear light and encodes the result as sRGB: the one conversion of the whole picture.
#include "shared/render_layout.h"

#if SAMPLES > 1
layout(binding = SCENE_COLOR_UNIT) uniform sampler2DMS sceneColor;
#else
layout(binding = SCENE_COLOR_UNIT) uniform sampler2D sceneColor;  // fetching level 0 reads as fetching sample 0
#endif
layout(location = 0) out vec4 color;

vec3 srgbEncoded(vec3 light) {
  return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0);
  for (int i = 0; i < SAMPLES; ++i) sum += texelFetch(sceneColor, pixel, i).rgb;
  color = vec4(srgbEncoded(clamp(sum / float(SAMPLES), 0.0, 1.0)), 1.0);
}
