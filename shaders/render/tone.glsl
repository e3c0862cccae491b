// From linear light to the canvas and back. The canvas keeps what the screen shows, so that it needs no pass of its own on the
// way there, which costs a software renderer as much as shading. (A canvas that OpenGL encodes as sRGB by itself costs a third
// more time on llvmpipe.)
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

// The curve of sRGB by square roots, which cost less than powers: off by at most 0.3 of 255 steps.
vec3 srgbEncoded(vec3 light) {
  vec3 root = sqrt(light), fourth = sqrt(root);
  vec3 curve = 0.588657 * root + 0.776431 * fourth - 0.364366 * sqrt(fourth);
  return mix(curve, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}
vec3 srgbDecoded(vec3 srgb) { return mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045))); }

// Square roots, as the backdrop is kept for exposures.
vec3 encodedLight(vec3 light) { return sqrt(toneMapped(light)); }
vec3 decodedLight(vec3 stored) { return stored * stored; }

// An exposure keeps its light as it is, in floating point: only the mean is mapped.
vec3 canvasFromLight(vec3 light) { return isExposure() ? light : srgbEncoded(toneMapped(light)); }
vec3 canvasFromEncoded(vec3 stored) { return isExposure() ? lightBeforeToneMapping(decodedLight(stored)) : srgbEncoded(decodedLight(stored)); }

// For colours that stand for themselves, such as a scale's: what the screen will show.
vec3 canvasFromSrgb(vec3 srgb) { return isExposure() ? lightBeforeToneMapping(srgbDecoded(srgb)) : srgb; }

const float STAGE_ALPHA = 254.0 / 255.0;  // of a canvas where only the stage is seen

// Less than a step of the canvas's 8 bits, so that wide, slow gradients show no contour lines.
float dither(vec2 pixel) { return (fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0; }
float canvasDither(vec2 pixel) { return isExposure() ? 0.0 : dither(pixel); }
