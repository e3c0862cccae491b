// Lays the drawn samples over the backdrop, averages them in linear light and encodes the result as sRGB.
#include "render/background.glsl"
#include "render/tone.glsl"

#ifndef SAMPLES
#define SAMPLES 4  // the renderer says how many
#endif
#if SAMPLES > 1
layout(binding = CANVAS_UNIT) uniform sampler2DMS canvas;
#else
layout(binding = CANVAS_UNIT) uniform sampler2D canvas;  // fetching level 0 reads as fetching sample 0
#endif
layout(location = 0) out vec4 color;

vec3 srgbEncoded(vec3 light) {
  return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}

void main() {
  vec3 backdrop = canvasFromLight(backgroundLight(gl_FragCoord.xy));
  vec3 sum = vec3(0);
  for (int i = 0; i < SAMPLES; ++i) {
    vec4 drawn = texelFetch(canvas, ivec2(gl_FragCoord.xy), i);
    sum += lightFromCanvas(drawn.rgb + (1.0 - drawn.a) * backdrop);
  }
  color = vec4(srgbEncoded(clamp(sum / float(SAMPLES), 0.0, 1.0)), 1.0);
}
