// Planes and the floor: matte, in a pool of light, fading out into the backdrop; from behind only a veil, to see the
// cloth through it.
#include "render/lights.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/tone.glsl"

const float BEHIND = 0.35;
const float POOL_SHARPNESS = 14.0;

layout(binding = FLOOR_SHADOW_UNIT) uniform sampler2D floorShadow;
layout(location = 0) in vec2 fromCenter;
layout(location = 1) in vec3 shadowPlace;
layout(location = 2) flat in vec3 keyLight;
layout(location = 3) flat in vec3 fillLight;
layout(location = 4) flat in vec3 behindLight;
layout(location = 5) flat in vec3 skyLight;
layout(location = 6) in vec3 planePosition;
layout(location = 7) flat in vec3 planeNormal;
layout(location = 0) out vec4 color;

void main() {
  float distance2 = dot(fromCenter, fromCenter);
  float fade = clamp(1.0 - distance2, 0.0, 1.0);
  float pool = 0.25 + 0.75 / (1.0 + POOL_SHARPNESS * distance2);
  // Softened, or in an exposure of a mean as its light throws it.
  float lit = isExposure() ? sunlit(shadowPlace) : texture(floorShadow, shadowPlace.xy).r;
  vec3 front = fillLight + skyLight * skyShare(planePosition, planeNormal) + keyLight * (pool * lit);
  vec3 light = gl_FrontFacing ? front : behindLight;
  float opacity = fade * fade * (gl_FrontFacing ? 1.0 : BEHIND);
  color = vec4((canvasFromLight(light) + canvasDither(gl_FragCoord.xy)) * opacity, opacity);
}
