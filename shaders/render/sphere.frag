// Solids: a matte colour under a clear coat whose highlight is narrower and brighter the glossier it is.
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

layout(location = 0) in Surface surface;
layout(location = 8) flat in vec4 look;  // linear colour and gloss
layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(surface.normal);
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  float lit = sunlit(surface.shadowPlace);
  float gloss = look.a, exponent = exp2(mix(2.0, 9.8, gloss));  // porcelain, of gloss 0.5: 60
  vec3 light = look.rgb * diffuseLight(normal, lit, skyShare(surface.position, normal));
  light += gloss * gloss * highlight(normal, toEye, exponent, lit);
  color = vec4(canvasFromLight(light), 1.0);
}
