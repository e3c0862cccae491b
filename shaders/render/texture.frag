// A picture on matte cloth; it shows through on the back, paler.
#include "render/lights.glsl"
#include "render/print.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float PALER = 0.35;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

void main() {
  vec3 albedo = printAt(surface.uv);
  if (!gl_FrontFacing) albedo = mix(albedo, vec3(0.6), PALER);
  vec3 normal = normalToEye();
  vec3 light = diffuseLight(normal, sunlit(surface.shadowPlace), skyShare(surface.position, normal));
  color = vec4(canvasFromLight(albedo * light), 1.0);
}
