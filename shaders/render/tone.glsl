// From linear light to the canvas and back. The canvas keeps square roots: 8 bits are then as fine in the shadows as a
// screen's, and the way back to linear light is one multiplication. (A canvas that OpenGL encodes as sRGB by itself costs
// a third more time on llvmpipe.)
#include "render/frame.glsl"

const float KNEE = 0.65;

// Linear up to a knee, then a soft shoulder that keeps highlights from clipping.
vec3 toneMapped(vec3 light) {
  vec3 above = max(light - KNEE, 0.0);
  return min(light, KNEE) + above / (1.0 + above / (1.0 - KNEE));
}

vec3 lightBeforeToneMapping(vec3 mapped) {
  vec3 above = max(mapped - KNEE, 0.0);
  return min(mapped, KNEE) + above / max(1.0 - above / (1.0 - KNEE), 0.01);
}

vec3 encodedLight(vec3 light) { return sqrt(toneMapped(light)); }
vec3 decodedLight(vec3 stored) { return stored * stored; }

// An exposure keeps its light as it is, in floating point: only the mean is mapped.
vec3 canvasFromLight(vec3 light) { return isExposure() ? light : encodedLight(light); }
vec3 canvasFromEncoded(vec3 stored) { return isExposure() ? lightBeforeToneMapping(decodedLight(stored)) : stored; }

// For colours that stand for themselves, such as a scale's: what the screen will show.
vec3 canvasFromSrgb(vec3 srgb) {
  return canvasFromEncoded(sqrt(mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)))));
}

// Less than a step of the canvas's 8 bits, so that wide, slow gradients show no contour lines.
float dither(vec2 pixel) { return (fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0; }
float canvasDither(vec2 pixel) { return isExposure() ? 0.0 : dither(pixel); }
