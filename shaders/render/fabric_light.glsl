// The light that woven cloth sends to the eye: matte threads under a sheen of fine fibres (charlie.glsl), and the shine along
// the threads that satin lives from, each family of threads a bundle of fibres (J. Kajiya, T. Kay, "Rendering Fur", 1989).
// Light comes from the key light and from the generated sky; folds shade themselves; a part of the light shines through.
#include "render/charlie.glsl"
#include "render/environment_light.glsl"
#include "render/frame.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tangent_frame.glsl"
#include "render/threads.glsl"

const float SHEEN = 0.32;
const float TRANSMITTED = 0.14;  // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.7;

vec3 directionToEye(vec3 position) { return normalize(frame.eye.xyz - position); }

// Between the threads of the warp, those of the weft show.
vec3 albedoOfThreads(vec3 dye, float warp) { return mix(mix(dye, vec3(0.80, 0.79, 0.76), frame.fabric.z), dye, warp); }

// All but the shine. `side`: 1 for the front, -1 for the back; `lit`: what shadows leave of the key light.
vec3 matteLight(Surface s, TangentFrame t, float side, Threads threads, vec3 albedo, float lit) {
  vec3 normal = tilted(t, threads.slope), toLight = frame.toKeyLight.xyz, toEye = directionToEye(s.position);
  vec3 halfway = normalize(toLight + toEye);
  float normalLight = clamp(dot(normal, toLight), 0.0, 1.0), normalEye = clamp(dot(normal, toEye), 0.02, 1.0);
  float open = openness(clamp(1.0 - HOLLOW_SHADE * s.hollow * side, 0.3, 1.12)) * threads.light;

  vec3 sky = skyIrradiance(normal) * (open * skyShare(s.position, normal));
  // A thread that leans to the light is still in the shade of its own cloth where that turns away.
  // (Highlights keep farther away from where the shadow map's edges run.)
  float facing = dot(t.normal, toLight);
  float terminator = smoothstep(0.0, 0.3, facing), highlit = smoothstep(0.05, 0.6, facing);
  vec3 key = frame.keyColor.rgb * lit;
  float fill = max(0.5 + 0.5 * dot(normal, frame.toFillLight.xyz), 0.0);
  float through = TRANSMITTED * max(-facing, 0.0);
  vec3 light = albedo * (key * (normalLight * terminator * threads.light + through) + sky + fill * fill * open * frame.fillColor.rgb);

  vec3 fibres = SHEEN * (0.05 + 0.95 * sqrt(albedo));
  return light + fibres * (key * highlit * sheenReflected(clamp(dot(normal, halfway), 0.0, 1.0), normalLight, normalEye) + sky * sheenAlbedo(normalEye));
}

// How the threads lie to the direction halfway between the eye and the light: its parts along u and v.
vec2 alongThreads(TangentFrame t, vec3 position) {
  vec3 halfway = normalize(frame.toKeyLight.xyz + directionToEye(position));
  return vec2(dot(t.u, halfway), dot(t.v, halfway));
}

// What part of the shine is to be seen.
float shineSeen(TangentFrame t, Threads threads, float lit) {
  return smoothstep(0.05, 0.6, dot(t.normal, frame.toKeyLight.xyz)) * threads.light * lit;
}

vec3 shineOf(vec2 along, float warp, vec3 albedo) {
  float gloss = frame.fabric.y;
  return threadShine(along, warp, mix(5.0, 44.0, gloss)) * (1.2 * gloss * gloss) * mix(vec3(0.30), sqrt(albedo), 0.6) * frame.keyColor.rgb;
}
