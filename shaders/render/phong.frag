// Two-sided Blinn-Phong for cloth: a broad, weak highlight, a sheen at grazing angles as fibres give it, light that
// shines through, and folds that darken in their hollows.
#include "render/hem.glsl"
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float HIGHLIGHT = 0.08, EXPONENT = 24.0;
const float SHEEN = 0.24;
const float TRANSMITTED = 0.12;     // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.4;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;

void main() {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 albedo = gl_FrontFacing ? frame.clothFront.rgb : frame.clothBack.rgb;
  albedo *= hem(surface.uv);
  vec3 normal = normalize(surface.normal) * side;
  vec3 toEye = normalize(frame.eye.xyz - surface.position);
  float lit = sunlit(surface.shadowPlace);

  float open = openness(clamp(1.0 - HOLLOW_SHADE * surface.hollow * side, 0.4, 1.15));
  float share = skyShare(surface.position, normal);
  float grazing = 1.0 - clamp(dot(normal, toEye), 0.0, 1.0);
  float rim = grazing * grazing * grazing;
  float matte = 1.0 - TRANSMITTED - highlightShare(HIGHLIGHT, EXPONENT) - SHEEN * rim;
  vec3 light = matte * diffuseLight(normal, lit, share) * open;
  light += TRANSMITTED * lit * max(-dot(normal, frame.toKeyLight.xyz), 0.0) * frame.keyColor.rgb;
  vec3 sheen = SHEEN * rim * open * share * ambientLight(normal) * mix(vec3(1), albedo, 0.7);
  color = vec4(canvasFromLight(albedo * light + HIGHLIGHT * highlight(normal, toEye, EXPONENT, lit) + sheen), 1.0);
}
