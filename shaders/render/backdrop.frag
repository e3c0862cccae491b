// The backdrop, kept as on the canvas but finer; or, to begin a picture, laid on the canvas.
#include "render/background.glsl"
#include "render/tone.glsl"

layout(location = 0) out vec4 color;

#ifdef LAY
layout(binding = BACKDROP_UNIT) uniform sampler2D backdrop;
void main() {
  vec3 stored = texelFetch(backdrop, ivec2(gl_FragCoord.xy), 0).rgb;
  color = vec4(canvasFromEncoded(stored) + canvasDither(gl_FragCoord.xy), 1.0);
}
#else
void main() { color = vec4(encodedLight(backgroundLight(gl_FragCoord.xy)), 1.0); }
#endif
