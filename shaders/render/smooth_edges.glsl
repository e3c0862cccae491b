// Edges of a canvas that has one sample a pixel. Before the include: `canvas`, filtered linearly.
#include "render/frame.glsl"

const float LEAST_CONTRAST = 0.04;
const float REACH = 6.0;  // [pixels] along an edge

float brightness(vec3 canvasColor) { return dot(canvasColor, vec3(0.3, 0.6, 0.1)); }
float brightnessAt(ivec2 pixel) {
  return brightness(texelFetch(canvas, clamp(pixel, ivec2(0), ivec2(frame.pixels.xy) - 1), 0).rgb);
}

// The edge's direction comes from the brightness of the four diagonal neighbours; colours are mixed along it (the idea of
// T. Lottes, "FXAA", 2009). Where there is no contrast, nothing changes.
vec3 smoothedCanvas(ivec2 at) {
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
  vec2 pixel = frame.pixels.zw, place = (vec2(at) + 0.5) * pixel;
  vec2 step = clamp(along / smaller, -REACH, REACH) * pixel;
  vec3 near = 0.5 * (texture(canvas, place - step / 6.0).rgb + texture(canvas, place + step / 6.0).rgb);
  vec3 wide = 0.5 * near + 0.25 * (texture(canvas, place - 0.5 * step).rgb + texture(canvas, place + 0.5 * step).rgb);
  float wideBrightness = brightness(wide);
  vec3 smoothed = wideBrightness < least || wideBrightness > most ? near : wide;
  return most - least < LEAST_CONTRAST ? here : smoothed;
}
