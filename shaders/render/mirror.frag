// A mirror that shows the generated sky, two-sided; at grazing angles it reflects all, else a little less.
#include "render/frame.glsl"
#include "render/shadow.glsl"
#include "render/sky.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const vec3 SILVER = vec3(0.92, 0.93, 0.95);
const float SUN_SHARPNESS = 600.0, SUN = 6.0;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

void main() {
  float side = facingSide();
  vec3 normal = normalToEye();
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  // Interpolated normals can face away at the rim.
  float facing = max(dot(normal, toEye), 0.0);
  vec3 reflected = reflect(-toEye, normal);
  float sun = exp2(SUN_SHARPNESS * (dot(reflected, frame.toKeyLight.xyz) - 1.0)) * sunlit(surface.shadowPlace);
  float rim = pow(1.0 - facing, 5.0);
  // Deep in folds a mirror sees the next fold instead of the sky.
  float open = clamp(1.0 - 1.6 * surface.hollow * side, 0.25, 1.0);
  vec3 light = mix(SILVER, vec3(1), rim) * (skyLight(reflected) * open + SUN * sun * frame.keyColor.rgb);
  color = vec4(canvasFromLight(light), 1.0);
}
