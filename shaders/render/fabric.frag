// Woven cloth: matte threads under a sheen of fine fibres (charlie.glsl), and the shine along the threads that satin lives
// from, each family of threads a bundle of fibres (J. Kajiya, T. Kay, "Rendering Fur", 1989). Light comes from the key
// light and from the generated sky; folds shade themselves; a part of the light shines through. The threads' relief is a
// picture with mipmaps whose slopes are level on average: with distance it fades into the cloth's own normal.
#include "render/charlie.glsl"
#include "render/cloth_piece.glsl"
#include "render/environment_light.glsl"
#include "render/frame.glsl"
#include "render/hem.glsl"
#include "render/shadow.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"
#ifdef PRINT
#include "render/print.glsl"
#endif

const float SHEEN = 0.32;
const float TRANSMITTED = 0.14;     // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.7;
const float PRINT_SEEN_FROM_BEHIND = 0.45;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/tangent_frame.glsl"
#include "render/threads.glsl"
#include "render/two_sided.glsl"

vec3 albedoAt(vec2 uv, float warp) {
  vec3 albedo = albedoOfSide();
#ifdef PRINT
  vec3 print = printAt(uv);
  albedo = gl_FrontFacing ? print : mix(albedo, print, PRINT_SEEN_FROM_BEHIND);
#endif
  return mix(mix(albedo, vec3(0.80, 0.79, 0.76), frame.fabric.z), albedo, warp) * hem(uv);
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
  float open = openness(clamp(1.0 - HOLLOW_SHADE * surface.hollow * side, 0.3, 1.12)) * threads.light;

  vec3 sky = skyIrradiance(normal) * (open * skyShare(surface.position, normal));
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
