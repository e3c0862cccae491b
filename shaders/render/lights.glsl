// The studio's lights on a matte surface; `normal` is unit and faces the viewer.
#include "render/frame.glsl"

vec3 ambientLight(vec3 normal) {
  return mix(frame.bounceColor.rgb, frame.skyColor.rgb, 0.5 + 0.5 * normal.y);
}

// Key light (where `lit` says that it arrives), and the share of the fill light, which is wide, and of the ambient light that
// does; without the surface's colour.
vec3 diffuseLight(vec3 normal, float lit, float share) {
  float key = max(dot(normal, frame.toKeyLight.xyz), 0.0) * lit;
  float fill = max(0.5 + 0.5 * dot(normal, frame.toFillLight.xyz), 0.0);
  return key * frame.keyColor.rgb + share * (fill * fill * frame.fillColor.rgb + ambientLight(normal));
}

// Blinn-Phong highlight of the key light.
vec3 highlight(vec3 normal, vec3 toEye, float exponent, float lit) {
  vec3 halfway = normalize(frame.toKeyLight.xyz + toEye);
  float facing = step(0.0, dot(normal, frame.toKeyLight.xyz));
  return frame.keyColor.rgb * (pow(max(dot(normal, halfway), 0.0), exponent) * lit * facing);
}

// The most that such a highlight, times `strength`, sends back of light from all around: matte light leaves so much to it.
float highlightShare(float strength, float exponent) { return strength * 8.0 / (exponent + 1.0); }
