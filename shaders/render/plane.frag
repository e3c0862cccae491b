// Planes and the ground: matte, in a pool of light, as far as the stage's ground goes; a plane in a colour of its own, or one
// that is no ground, fades out into the backdrop. Where that shows the ground, too (GROUND_BEHIND), both are alike but for
// shadows, so that the renderer may draw it under shadows alone. From behind only a veil, to see the cloth through it.
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/stage.glsl"
#include "render/tone.glsl"

const float BEHIND = 0.35;

layout(binding = FLOOR_SHADOW_UNIT) uniform sampler2D floorShadow;
layout(location = 0) in vec2 fromCenter;
layout(location = 1) in vec3 shadowPlace;
layout(location = 2) flat in vec3 keyLight;
layout(location = 3) flat in vec3 wideLight;
layout(location = 4) flat in vec3 behindLight;
layout(location = 6) in vec3 planePosition;
layout(location = 7) flat in vec3 planeNormal;
layout(location = 8) flat in vec4 look;
layout(location = 0) out vec4 color;

// Softened, or in an exposure of a mean as its light throws it.
float litAt() {
  if (isExposure()) return sunlit(shadowPlace);
  float lit = texture(floorShadow, shadowPlace.xy).r;
#ifdef WINDOW
  lit *= windowLight(shadowPlace.xy);
#endif
  return lit;
}

void main() {
  bool isGround = look.r < 0.0 && planeNormal.y > 0.95;
  vec2 at = isGround ? fromMiddle(planePosition) : fromCenter * STAGE_SIZES;
  float distance2 = dot(fromCenter, fromCenter), fade = clamp(1.0 - distance2, 0.0, 1.0);
  float covered = isGround ? groundCovers(at, max(fwidth(at.x), fwidth(at.y))) : fade * fade;
  vec3 albedo = isGround ? groundAlbedo(planePosition) * edgeLight(at) : look.r < 0.0 ? frame.floorColor.rgb : look.rgb;
  float lit = poolAt(at) * litAt();
  vec3 front = albedo * (wideLight * skyShare(planePosition, planeNormal) + keyLight * lit);
  if (isGround) front += groundShine(planePosition, planeNormal, lit);
#ifdef GROUND_BEHIND
  if (isGround) front = groundInto(front, at, normalize(planePosition - frame.eye.xyz));
#endif
  vec3 light = gl_FrontFacing ? front : albedo * behindLight;
  float opacity = covered * (gl_FrontFacing ? 1.0 : BEHIND);
  color = vec4((canvasFromLight(light) + canvasDither(gl_FragCoord.xy)) * opacity, opacity);
}
