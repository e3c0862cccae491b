// Lambert's law alone: matte cloth, two-sided.
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

void main() {
  vec3 normal = normalToEye();
  vec3 light = diffuseLight(normal, sunlit(surface.shadowPlace), skyShare(surface.position, normal));
  color = vec4(canvasFromLight(albedoOfSide() * light), 1.0);
}
