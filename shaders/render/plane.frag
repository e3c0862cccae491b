// Planes and the floor: matte, fading out into the background; from behind only a veil, to see the cloth through it.
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float BEHIND = 0.35;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;

void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, length(surface.uv));
  float opacity = fade * (gl_FrontFacing ? 1.0 : BEHIND);
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 light = frame.floorColor.rgb * diffuseLight(surface.normal * side, sunlit(surface.shadowPlace));
  color = vec4(toneMapped(light), opacity);
}
