// Cloth: positions from the particle buffer, normals from the normals pass.
#include "render/frame.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;
layout(location = 0) out Surface surface;

void main() {
  surface = Surface(position.xyz, normal.xyz, uv, normal.w,
                    shadowPlaceOf(position.xyz, normal.xyz, CLOTH_OFFSET_TEXELS));
  gl_Position = frame.clipFromWorld * vec4(position.xyz, 1.0);
}
