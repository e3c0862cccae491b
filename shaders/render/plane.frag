// Planes and the floor: matte, in a pool of light, fading out into the backdrop; from behind only a veil, to see the
// cloth through it.
#include "render/lights.glsl"
#include "render/tone.glsl"

const float BEHIND = 0.35;
const float POOL_SHARPNESS = 14.0;

layout(binding = FLOOR_SHADOW_UNIT) uniform sampler2D floorShadow;
layout(location = 0) in vec2 fromCenter;
layout(location = 1) in vec2 shadowPlace;
layout(location = 2) flat in vec3 keyLight;
layout(location = 3) flat in vec3 shadeLight;
layout(location = 4) flat in vec3 behindLight;
layout(location = 0) out vec4 color;

void main() {
  float distance2 = dot(fromCenter, fromCenter);
  float fade = clamp(1.0 - distance2, 0.0, 1.0);
  float pool = 0.25 + 0.75 / (1.0 + POOL_SHARPNESS * distance2);
  vec3 front = shadeLight + keyLight * (pool * texture(floorShadow, shadowPlace).r);
  vec3 light = gl_FrontFacing ? front : behindLight;
  float opacity = fade * fade * (gl_FrontFacing ? 1.0 : BEHIND);
  color = vec4((canvasFromLight(light) + dither(gl_FragCoord.xy)) * opacity, opacity);
}
