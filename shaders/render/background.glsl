// What is behind everything, in linear light: the stage, the generated sky, or one colour.
#include "render/frame.glsl"
#if defined(SKY)
#include "render/sky.glsl"
#elif !defined(PLAIN) && !defined(BARE)
#include "render/walls.glsl"
#endif

vec3 rayThrough(vec2 pixel) {
  vec2 place = pixel * frame.pixels.zw * 2.0 - 1.0;
  return frame.rayMiddle.xyz + place.x * frame.rayRight.xyz + place.y * frame.rayUp.xyz;
}

#if defined(SKY)
vec3 backgroundLight(vec2 pixel) { return skyLight(rayThrough(pixel)); }
#elif defined(PLAIN)
vec3 backgroundLight(vec2 pixel) { return frame.backgroundPlain.rgb; }
#elif defined(BARE)
// A vertical gradient with a glow behind the cloth.
vec3 backgroundLight(vec2 pixel) {
  vec2 place = pixel * frame.pixels.zw;
  vec2 fromMiddle = (place - vec2(0.5, 0.55)) * vec2(frame.pixels.x * frame.pixels.w, 1.0);
  float glow = exp(-3.0 * dot(fromMiddle, fromMiddle));
  vec3 light = mix(frame.backgroundBottom.rgb, frame.backgroundTop.rgb, smoothstep(0.0, 1.0, place.y));
  return light + glow * frame.backgroundGlow.rgb;
}
#else
vec3 backgroundLight(vec2 pixel) { return stageBehind(frame.eye.xyz, normalize(rayThrough(pixel))); }
#endif
