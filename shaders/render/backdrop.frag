// The backdrop, kept as it is on the canvas, or for exposures finer; or, to begin a picture, laid on the canvas.
#include "render/background.glsl"
#include "render/tone.glsl"

layout(location = 0) out vec4 color;

#ifdef LAY
layout(binding = BACKDROP_UNIT) uniform sampler2D backdrop;
void main() {
  vec3 stored = texelFetch(backdrop, ivec2(gl_FragCoord.xy), 0).rgb;
  color = isExposure() ? vec4(canvasFromEncoded(stored), 1.0) : vec4(stored, STAGE_ALPHA);
}
#else
void main() {
  vec3 light = backgroundLight(gl_FragCoord.xy);
  color = vec4(isExposure() ? encodedLight(light) : canvasFromLight(light) + canvasDither(gl_FragCoord.xy), STAGE_ALPHA);
}
#endif
