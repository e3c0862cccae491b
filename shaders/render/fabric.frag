// Woven cloth: matte threads under a sheen of fine fibres (charlie.glsl), and the shine along the threads that satin lives
// from, each family of threads a bundle of fibres (J. Kajiya, T. Kay, "Rendering Fur", 1989). Light comes from the key
// light and from the generated sky; folds shade themselves; a part of the light shines through. The threads' relief is a
// picture with mipmaps whose slopes are level on average: with distance it fades into the cloth's own normal.
#include "render/charlie.glsl"
#include "render/cloth_grid.glsl"
#include "render/environment_light.glsl"
#include "render/frame.glsl"
#include "render/hem.glsl"
#include "render/shadow.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"
#ifdef PRINT
#include "render/print.glsl"
#endif
#ifdef WOVEN
layout(binding = WEAVE_UNIT) uniform sampler2D weave;
#endif

const float SLOPE_RANGE = 3.0;      // of the weaves' pictures (tools/make_textures)
const float FLATTENED = 0.5;        // threads are pressed flat, compared with those pictures
const float SHEEN = 0.32;
const float TRANSMITTED = 0.14;     // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.7;
const float PRINT_SEEN_FROM_BEHIND = 0.45;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/tangent_frame.glsl"
#include "render/two_sided.glsl"

struct Threads {
  vec2 slope;   // of their surface, along u and v
  float light;  // that reaches down between them
  float warp;   // part of the surface that is warp, the threads along v
};

Threads threadsAt(vec2 uv, float side) {
#ifdef WOVEN
  // One mipmap smaller than usual: the weave repeats every two threads, which a pixel of one thread would turn into moire.
  vec4 stored = texture(weave, uv * vec2(grid.width, grid.height) * frame.fabric.x, 1.0);
  vec2 slope = (stored.rg * 2.0 - 256.0 / 255.0) * (SLOPE_RANGE * FLATTENED * frame.relief.x);
  return Threads(slope, stored.b, side > 0.0 ? stored.a : 1.0 - stored.a);  // what is below on one side is above on the other
#else
  return Threads(vec2(0), 1.0, 0.5);
#endif
}

vec3 albedoAt(vec2 uv, float warp) {
  vec3 albedo = albedoOfSide();
#ifdef PRINT
  vec3 print = printAt(uv);
  albedo = gl_FrontFacing ? print : mix(albedo, print, PRINT_SEEN_FROM_BEHIND);
#endif
  return mix(mix(albedo, vec3(0.80, 0.79, 0.76), frame.fabric.z), albedo, warp) * hem(uv);
}

// Highlights of fibres along u (weft) and v (warp).
float threadShine(TangentFrame t, float warp, vec3 halfway, float exponent) {
  float alongU = dot(t.u, halfway), alongV = dot(t.v, halfway);
  float weftShine = pow(1.0 - alongU * alongU, exponent), warpShine = pow(1.0 - alongV * alongV, exponent);
  return mix(weftShine, warpShine, warp);
}

void main() {
  float side = facingSide(), gloss = frame.fabric.y;
  TangentFrame t = tangentFrame(side);
  Threads threads = threadsAt(surface.uv, side);
  vec3 normal = tilted(t, threads.slope);
  vec3 albedo = albedoAt(surface.uv, threads.warp);

  vec3 toLight = frame.toKeyLight.xyz, toEye = normalize(frame.eye.xyz - surface.position);
  vec3 halfway = normalize(toLight + toEye);
  float lit = sunlit(surface.shadowPlace);
  float normalLight = clamp(dot(normal, toLight), 0.0, 1.0), normalEye = clamp(dot(normal, toEye), 0.02, 1.0);
  float open = clamp(1.0 - HOLLOW_SHADE * surface.hollow * side, 0.3, 1.12) * threads.light;

  vec3 sky = skyIrradiance(normal) * open;
  // A thread that leans to the light is still in the shade of its own cloth where that turns away.
  // (Highlights keep farther away from where the shadow map's edges run.)
  float facing = dot(t.normal, toLight);
  float terminator = smoothstep(0.0, 0.3, facing), highlit = smoothstep(0.05, 0.6, facing);
  vec3 key = frame.keyColor.rgb * lit;
  float fill = max(0.5 + 0.5 * dot(normal, frame.toFillLight.xyz), 0.0);
  float through = TRANSMITTED * max(-facing, 0.0);
  vec3 light = albedo * (key * (normalLight * terminator * threads.light + through) + sky + fill * fill * open * frame.fillColor.rgb);

  vec3 fibres = SHEEN * (0.05 + 0.95 * sqrt(albedo));
  light += fibres * (key * highlit * sheenReflected(clamp(dot(normal, halfway), 0.0, 1.0), normalLight, normalEye) + sky * sheenAlbedo(normalEye));
  float shine = threadShine(t, threads.warp, halfway, mix(5.0, 44.0, gloss)) * 1.5 * gloss * gloss * highlit;
  light += mix(vec3(0.30), sqrt(albedo), 0.6) * (0.8 * shine * threads.light) * key;
  color = vec4(canvasFromLight(light), 1.0);
}
