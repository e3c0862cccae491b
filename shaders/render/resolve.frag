// From the canvas to the screen: samples are averaged in linear light, or, where each pixel has just one, the edges smoothed;
// the result is encoded as sRGB. ADDS: the light alone, to be added to a mean; MEAN: from such a sum to the screen.
#include "render/frame.glsl"
#include "render/tone.glsl"

#ifndef SAMPLES
#define SAMPLES 4  // the renderer says how many
#endif
#if SAMPLES > 1
layout(binding = CANVAS_UNIT) uniform sampler2DMS canvas;
#else
layout(binding = CANVAS_UNIT) uniform sampler2D canvas;
#endif
layout(location = 0) out vec4 color;

// The curve of sRGB by square roots, which cost less than powers: off by at most 0.3 of 255 steps.
vec3 srgbEncoded(vec3 light) {
  vec3 root = sqrt(light), fourth = sqrt(root);
  vec3 curve = 0.588657 * root + 0.776431 * fourth - 0.364366 * sqrt(fourth);
  return mix(curve, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}

#if defined(MEAN)
vec3 pixelLight() {
  vec4 sum = texelFetch(canvas, ivec2(gl_FragCoord.xy), 0);
  return toneMapped(sum.rgb / sum.a);
}
#elif SAMPLES > 1
vec3 pixelLight() {
  vec3 sum = vec3(0);
  for (int i = 0; i < SAMPLES; ++i) {
    vec3 stored = texelFetch(canvas, ivec2(gl_FragCoord.xy), i).rgb;
#ifdef ADDS
    sum += stored;
#else
    sum += decodedLight(stored);
#endif
  }
  return sum / float(SAMPLES);
}
#elif defined(ADDS)
vec3 pixelLight() { return texelFetch(canvas, ivec2(gl_FragCoord.xy), 0).rgb; }
#else
#include "render/smooth_edges.glsl"
vec3 pixelLight() { return smoothedLight(ivec2(gl_FragCoord.xy)); }
#endif

void main() {
#ifdef ADDS
  color = vec4(pixelLight(), 1.0);
#else
  vec2 otherNoise = gl_FragCoord.xy + 37.0;  // than that of the canvas, whose steps are not the screen's
  color = vec4(srgbEncoded(clamp(pixelLight(), 0.0, 1.0)) + dither(otherNoise), 1.0);
#endif
}
