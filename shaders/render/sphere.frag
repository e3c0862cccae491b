// Spheres: smooth porcelain that leaves the stage to the cloth.
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float HIGHLIGHT = 0.25, EXPONENT = 60.0;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(surface.normal);
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  float lit = sunlit(surface.shadowPlace);
  vec3 light = frame.sphereColor.rgb * diffuseLight(normal, lit, skyShare(surface.position, normal)) + HIGHLIGHT * highlight(normal, toEye, EXPONENT, lit);
  color = vec4(canvasFromLight(light), 1.0);
}
