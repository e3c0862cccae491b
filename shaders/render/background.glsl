// A studio backdrop: a vertical gradient with a glow behind the cloth, in linear light.
#include "render/frame.glsl"

vec3 backgroundLight(vec2 pixel) {
  vec2 place = pixel * frame.pixels.zw;
  vec2 fromMiddle = (place - vec2(0.5, 0.55)) * vec2(frame.pixels.x * frame.pixels.w, 1.0);
  float glow = exp(-3.0 * dot(fromMiddle, fromMiddle));
  vec3 light = mix(frame.backgroundBottom.rgb, frame.backgroundTop.rgb, smoothstep(0.0, 1.0, place.y));
  return light + glow * frame.backgroundGlow.rgb;
}
