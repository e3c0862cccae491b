// From the canvas to the screen: samples are averaged in linear light, or, where each pixel has just one, the edges smoothed
// (which is only drawn where there are any: src/render/edges.h). ADDS: the light alone, to be added to a mean; MEAN: from such
// a sum to the screen.
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
    sum += srgbDecoded(stored);
#endif
  }
  return sum / float(SAMPLES);
}
#elif defined(ADDS)
vec3 pixelLight() { return texelFetch(canvas, ivec2(gl_FragCoord.xy), 0).rgb; }
#else
#define EDGES
#include "render/smooth_edges.glsl"
#endif

void main() {
#if defined(ADDS)
  color = vec4(pixelLight(), 1.0);
#elif defined(EDGES)
  color = smoothedCanvas(ivec2(gl_FragCoord.xy));
#else
  vec2 otherNoise = gl_FragCoord.xy + 37.0;  // than that of the canvas, whose steps are not the screen's
  color = vec4(srgbEncoded(clamp(pixelLight(), 0.0, 1.0)) + dither(otherNoise), 1.0);
#endif
}
