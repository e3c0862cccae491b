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
#ifdef LIT_AT_VERTICES
#include "render/lit_vertex.glsl"
#include "render/shadow.glsl"
#include "render/fabric_light.glsl"
layout(location = 0) out LitVertex lit;
#else
layout(location = 0) out Surface seen;
#endif
invariant gl_Position;  // the same as in cloth_depth.vert

#ifdef LIT_AT_VERTICES
LitVertex litVertex(Surface surface) {
  TangentFrame front = tangentFrame(surface, 1.0), back = tangentFrame(surface, -1.0);
  Threads ofFront = threadsAt(surface.uv, 1.0), ofBack = threadsAt(surface.uv, -1.0);
  LitVertex vertex;
#ifdef PLAIN
  vertex.uv = surface.uv;
  vertex.warp = ofFront.warp;
#ifdef PRINT
  vec3 albedoOfFront = vec3(1), albedoOfBack = vec3(1);
#else
  vec3 albedoOfFront = albedoOfThreads(frame.clothFront.rgb, ofFront.warp), albedoOfBack = albedoOfThreads(frame.clothBack.rgb, ofBack.warp);
#endif
  vertex.shadowPlace = surface.shadowPlace;
  vertex.front = matteLight(surface, front, 1.0, ofFront, albedoOfFront, 0.0);
  vertex.back = matteLight(surface, back, -1.0, ofBack, albedoOfBack, 0.0);
  vertex.frontKey = matteLight(surface, front, 1.0, ofFront, albedoOfFront, 1.0) - vertex.front;
  vertex.backKey = matteLight(surface, back, -1.0, ofBack, albedoOfBack, 1.0) - vertex.back;
#else
  float unshadowed = sunlit(surface.shadowPlace);
  vec2 along = alongThreads(front, surface.position);
  vertex.front = vec4(matteLight(surface, front, 1.0, ofFront, albedoOfThreads(frame.clothFront.rgb, ofFront.warp), unshadowed), along.x);
  vertex.back = vec4(matteLight(surface, back, -1.0, ofBack, albedoOfThreads(frame.clothBack.rgb, ofBack.warp), unshadowed), along.y);
  float shine = shineSeen(front, ofFront, unshadowed) - shineSeen(back, ofBack, unshadowed);  // one of them is 0
  vertex.cloth = vec4(surface.uv, shine, ofFront.warp);
#endif
  return vertex;
}
#endif

void main() {
  vec3 point = drawnPoint(position.xyz, normal, uv);
  vec3 litPlace = litPoint(position.xyz, normal, uv, frame.toKeyLight.xyz);
  Surface surface;
  surface.position = point;
  surface.normal = normal.xyz;
  surface.uv = uv;
  surface.hollow = normal.w;
  surface.shadowPlace = shadowPlaceOf(litPlace, normal.xyz, CLOTH_OFFSET_TEXELS);
#ifdef TANGENT
  surface.tangent = tangent.xyz;
#endif
#ifdef STRAIN
  surface.strain = tangent.w;
#endif
#ifdef LIT_AT_VERTICES
  lit = litVertex(surface);
#else
  seen = surface;
#endif
  gl_Position = frame.clipFromWorld * vec4(point, 1.0);
}
