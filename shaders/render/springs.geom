// Lines of a fixed width on the screen, with a border of half a pixel that fades out.
#include "render/frame.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 0) in vec4 look[];  // sRGB, and the width [pixels]
layout(location = 0) flat out vec3 lineColor;
layout(location = 1) flat out float halfWidth;
layout(location = 2) noperspective out float across;  // [pixels] from the middle
layout(location = 3) flat out float opacity;

const float OPAQUE_LENGTH = 14.0, LEAST_OPACITY = 0.2;  // [pixels]; where springs are dense the cloth still shows
const float LEAST_W = 1e-4;  // behind the eye nothing is drawn

void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  if (min(a.w, b.w) < LEAST_W) return;
  vec2 along = (b.xy / b.w - a.xy / a.w) * frame.pixels.xy;
  float l = length(along);
  if (l < 1e-4) return;
  float reach = 0.5 * look[0].w + 0.5;
  vec2 aside = vec2(-along.y, along.x) / l * (2.0 * reach) * frame.pixels.zw;
  for (int corner = 0; corner < 4; ++corner) {
    vec4 end = corner < 2 ? a : b;
    float side = (corner & 1) == 0 ? -1.0 : 1.0;
    lineColor = look[0].rgb;
    halfWidth = 0.5 * look[0].w;
    across = side * reach;
    opacity = clamp(l / OPAQUE_LENGTH, LEAST_OPACITY, 1.0);
    gl_Position = vec4(end.xy + side * aside * end.w, end.zw);
    EmitVertex();
  }
  EndPrimitive();
}
