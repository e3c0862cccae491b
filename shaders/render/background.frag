// A studio backdrop: a vertical gradient with a glow behind the cloth.
#include "render/frame.glsl"
#include "render/tone.glsl"

layout(location = 0) out vec4 color;

void main() {
  vec2 place = gl_FragCoord.xy * frame.pixels.zw;
  vec2 fromMiddle = (place - vec2(0.5, 0.52)) * vec2(frame.pixels.x * frame.pixels.w, 1.0);
  float glow = exp(-3.0 * dot(fromMiddle, fromMiddle));
  vec3 light = mix(frame.backgroundBottom.rgb, frame.backgroundTop.rgb, smoothstep(0.0, 1.0, place.y));
  color = vec4(toneMapped(light + glow * frame.backgroundGlow.rgb), 1.0);
}
