// Woven cloth (fabric_light.glsl). The threads' relief is a picture with mipmaps whose slopes are level on average: with
// distance it fades into the cloth's own normal. LIT_AT_VERTICES: cloth.vert has worked out the light of both sides, but for
// the shine, which would show the triangles. PLAIN: so it has, and there is no shine, thread or hem to be seen, but shadows are
// those of pixels.
#include "render/cloth_piece.glsl"
#include "render/dye.glsl"
#include "render/fabric_light.glsl"
#include "render/frame.glsl"
#ifdef WOVEN
#include "render/hem.glsl"
#else
float hem(vec2 uv) { return 1.0; }  // nobody hems a film
#endif
#include "render/shadow.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

layout(location = 0) out vec4 color;

#ifdef LIT_AT_VERTICES
#include "render/lit_vertex.glsl"
layout(location = 0) in LitVertex lit;

#ifdef PLAIN
vec3 light() {
  vec3 light = (gl_FrontFacing ? lit.front : lit.back) + (gl_FrontFacing ? lit.frontKey : lit.backKey) * sunlitOnce(lit.shadowPlace);
#ifdef PRINT
  light *= albedoOfThreads(dyeAt(lit.uv, gl_FrontFacing ? 1.0 : -1.0), gl_FrontFacing ? lit.warp : 1.0 - lit.warp);
#endif
  return light;
}
#else
vec3 light() {
  vec3 dye = gl_FrontFacing ? frame.clothFront.rgb : frame.clothBack.rgb;
  float side = gl_FrontFacing ? 1.0 : -1.0, warp = gl_FrontFacing ? lit.cloth.w : 1.0 - lit.cloth.w;
  vec3 shine = shineOf(vec2(lit.front.w, lit.back.w), warp, albedoOfThreads(dye, warp), side) * max(side * lit.cloth.z, 0.0);
  return ((gl_FrontFacing ? lit.front.rgb : lit.back.rgb) + shine) * hem(lit.cloth.xy);
}
#endif
#else
layout(location = 0) in Surface surface;
#include "render/two_sided.glsl"

vec3 light() {
  float side = facingSide(), lit = sunlit(surface.shadowPlace);
  TangentFrame t = tangentFrame(surface, side);
  Threads threads = threadsAt(surface.uv, side);
  vec3 albedo = albedoOfThreads(dyeAt(surface.uv, side) * threads.dye, threads.warp) * hem(surface.uv);
  vec3 shine = shineOf(alongThreads(t, surface.position), threads.warp, albedo, side) * shineSeen(t, threads, lit);
  return matteLight(surface, t, side, threads, albedo, lit) + shine;
}
#endif

void main() { color = vec4(canvasFromLight(light()), 1.0); }
