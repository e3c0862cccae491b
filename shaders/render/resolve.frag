// From the canvas to the screen: samples are averaged in linear light, or, where each pixel has just one, the edges smoothed;
// the result is encoded as sRGB.
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

#if SAMPLES > 1
vec3 pixelLight() {
  vec3 sum = vec3(0);
  for (int i = 0; i < SAMPLES; ++i) sum += lightFromCanvas(texelFetch(canvas, ivec2(gl_FragCoord.xy), i).rgb);
  return sum / float(SAMPLES);
}
#else
const float LEAST_CONTRAST = 0.04;
const float REACH = 6.0;  // [pixels] along an edge

float brightness(vec3 canvasColor) { return dot(canvasColor, vec3(0.3, 0.6, 0.1)); }
float brightnessAt(ivec2 pixel) {
  return brightness(texelFetch(canvas, clamp(pixel, ivec2(0), ivec2(frame.pixels.xy) - 1), 0).rgb);
}

// The edge's direction comes from the brightness of the four diagonal neighbours; colours are mixed along it (the idea of
// T. Lottes, "FXAA", 2009). Where there is no contrast, nothing changes.
vec3 pixelLight() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 here = texelFetch(canvas, at, 0).rgb;
  float upperLeft = brightnessAt(at + ivec2(-1, 1)), upperRight = brightnessAt(at + ivec2(1, 1));
  float lowerLeft = brightnessAt(at + ivec2(-1, -1)), lowerRight = brightnessAt(at + ivec2(1, -1));
  float least = min(min(upperLeft, upperRight), min(lowerLeft, lowerRight));
  float most = max(max(upperLeft, upperRight), max(lowerLeft, lowerRight));
  least = min(least, brightness(here));
  most = max(most, brightness(here));

  vec2 along = vec2(lowerLeft + lowerRight - upperLeft - upperRight, upperLeft + lowerLeft - upperRight - lowerRight);
  along.x = -along.x;
  float smaller = min(abs(along.x), abs(along.y)) + 0.03 * (least + most) + 1e-4;
  vec2 pixel = frame.pixels.zw, place = gl_FragCoord.xy * pixel;
  vec2 step = clamp(along / smaller, -REACH, REACH) * pixel;
  vec3 near = 0.5 * (texture(canvas, place - step / 6.0).rgb + texture(canvas, place + step / 6.0).rgb);
  vec3 wide = 0.5 * near + 0.25 * (texture(canvas, place - 0.5 * step).rgb + texture(canvas, place + 0.5 * step).rgb);
  float wideBrightness = brightness(wide);
  vec3 smoothed = wideBrightness < least || wideBrightness > most ? near : wide;
  return lightFromCanvas(most - least < LEAST_CONTRAST ? here : smoothed);
}
#endif

void main() {
  vec2 otherNoise = gl_FragCoord.xy + 37.0;  // than that of the canvas, whose steps are not the screen's
  color = vec4(srgbEncoded(clamp(pixelLight(), 0.0, 1.0)) + dither(otherNoise), 1.0);
}
