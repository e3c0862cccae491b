// Cloth: positions from the particle buffer, normals and tangents from the normals pass.
#include "render/frame.glsl"
#include "render/cloth_point.glsl"
#include "render/shadow_place.glsl"
#include "render/surface.glsl"

layout(location = POSITION_LOCATION) in vec4 position;
layout(location = NORMAL_LOCATION) in vec4 normal;
layout(location = TEXTURE_COORDINATE_LOCATION) in vec2 uv;
#if defined(TANGENT) || defined(STRAIN)
layout(location = TANGENT_LOCATION) in vec4 tangent;
#endif
layout(location = 0) out Surface surface;
invariant gl_Position;  // the same as in cloth_depth.vert

void main() {
  vec3 point = drawnPoint(position.xyz, normal, uv);
  vec3 lit = litPoint(position.xyz, normal, uv, frame.toKeyLight.xyz);
  surface.position = point;
  surface.normal = normal.xyz;
  surface.uv = uv;
  surface.hollow = normal.w;
  surface.shadowPlace = shadowPlaceOf(lit, normal.xyz, CLOTH_OFFSET_TEXELS);
#ifdef TANGENT
  surface.tangent = tangent.xyz;
#endif
#ifdef STRAIN
  surface.strain = tangent.w;
#endif
  gl_Position = frame.clipFromWorld * vec4(point, 1.0);
}
