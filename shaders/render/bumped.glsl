// Cloth with a height map, shaded as Blinn-Phong does; for bump.frag, where only the normal knows of the heights, and
// displacement.frag, where the surface follows them.
#include "render/lights.glsl"
#include "render/relief.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float HIGHLIGHT = 0.16, EXPONENT = 30.0;
const float HOLLOW_SHADE = 1.2;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/tangent_frame.glsl"
#include "render/two_sided.glsl"

void shadeBumped() {
  float side = facingSide();
  TangentFrame t = tangentFrame(surface, side);
  // What rises on the front sinks on the back.
  vec3 normal = tilted(t, slopeOfRelief(surface.uv) * side);
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  float lit = sunlit(surface.shadowPlace);
  float open = openness(clamp(1.0 - HOLLOW_SHADE * surface.hollow * side, 0.45, 1.1));
  vec3 light = albedoOfSide() * (1.0 - highlightShare(HIGHLIGHT, EXPONENT)) * diffuseLight(normal, lit, skyShare(surface.position, normal)) * open;
  color = vec4(canvasFromLight(light + HIGHLIGHT * highlight(normal, toEye, EXPONENT, lit)), 1.0);
}
