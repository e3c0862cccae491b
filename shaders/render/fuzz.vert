// A shell of fuzz (src/render/fuzz.cpp): the surface of cloth.vert, farther out on the side that is seen.
#include "render/frame.glsl"
#include "render/cloth_point.glsl"
#include "render/fuzz_shell.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;
layout(location = TANGENT_LOCATION) in vec4 tangent;
layout(location = 0) out Surface seen;
layout(location = 7) out float side;

void main() {
  vec3 point = drawnPoint(position.xyz, normal, uv);
  side = sideOf(facingOf(position.xyz, normal));
  point += normal.xyz * (shell.x * frame.fuzz * side);
  seen.position = point;
  seen.normal = normal.xyz;
  seen.uv = uv;
  seen.hollow = normal.w;
  seen.shadowPlace = shadowPlaceOf(litPoint(position.xyz, normal, uv, frame.toKeyLight.xyz), normal.xyz, CLOTH_OFFSET_TEXELS);
  seen.tangent = tangent.xyz;
  gl_Position = frame.clipFromWorld * vec4(point, 1.0);
}
