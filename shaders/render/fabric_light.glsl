// The light that woven cloth sends to the eye: matte threads under a sheen of fine fibres (charlie.glsl), and the shine along
// the threads that satin lives from, each family of threads a bundle of fibres (J. Kajiya, T. Kay, "Rendering Fur", 1989).
// Without a weave it is a film, as rubber or paper: it has no fibres, but reflects as a rough dielectric does.
// Light comes from the key light and from the generated sky; folds shade themselves; a part of the light shines through.
#include "render/charlie.glsl"
#include "render/environment_light.glsl"
#include "render/frame.glsl"
#include "render/sky_share.glsl"
#include "render/surface.glsl"
#include "render/tangent_frame.glsl"
#include "render/threads.glsl"

const float TRANSMITTED = 0.14;  // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.7;
const float SATIN_SKY = 0.45;      // part of the sky's light that silk sends on along its threads
const float FILM_REFLECTED = 0.04;  // of light from straight ahead, at a refractive index of 1.5

vec3 directionToEye(vec3 position) { return normalize(frame.eye.xyz - position); }

// Between the threads of the warp, those of the weft show.
vec3 albedoOfThreads(vec3 dye, float warp) { return mix(mix(dye, frame.weft.rgb, frame.weft.w), dye, warp); }

// The rest is matte: glossy threads send less light through themselves in all directions.
float matteShare() {
#ifdef WOVEN
  return 1.0 - 0.3 * frame.fabric.z * frame.fabric.z;
#else
  return 1.0;
#endif
}

vec3 shineTint(vec3 albedo) { return mix(vec3(0.30), sqrt(albedo), 0.6); }

// What comes from the sky without being dyed as matte light is: along the threads, or off a film (C. Schlick, "An Inexpensive
// BRDF Model for Physically-based Rendering", 1994). A bundle of fibres has normals all around it: the one that faces the eye
// most is that of its reflection.
vec3 skyShine(TangentFrame t, Threads threads, vec3 normal, vec3 toEye, vec3 albedo, float share) {
  float gloss = frame.fabric.z;
#ifdef WOVEN
  vec3 ofFibres = normalize(toEye - dot(toEye, t.v) * t.v + 0.3 * normal);
  return skyIrradiance(reflect(-toEye, ofFibres)) * (share * SATIN_SKY * gloss * gloss * threads.warp) * shineTint(albedo);
#else
  float grazing = 1.0 - clamp(dot(normal, toEye), 0.0, 1.0), grazing2 = grazing * grazing;
  float reflected = FILM_REFLECTED + (1.0 - FILM_REFLECTED) * grazing2 * grazing2 * grazing;
  return skyIrradiance(reflect(-toEye, normal)) * (share * reflected * mix(0.3, 1.0, gloss));
#endif
}

// All but the shine of the key light. `side`: 1 for the front, -1 for the back; `lit`: what shadows leave of the key light.
vec3 matteLight(Surface s, TangentFrame t, float side, Threads threads, vec3 albedo, float lit) {
  vec3 normal = tilted(t, threads.slope), toLight = frame.toKeyLight.xyz, toEye = directionToEye(s.position);
  vec3 halfway = normalize(toLight + toEye);
  float normalLight = clamp(dot(normal, toLight), 0.0, 1.0), normalEye = clamp(dot(normal, toEye), 0.02, 1.0);
  float open = openness(clamp(1.0 - HOLLOW_SHADE * s.hollow * side, 0.3, 1.12)) * threads.light;

  float share = open * skyShare(s.position, normal);
  vec3 sky = skyIrradiance(normal) * share;
  // A thread that leans to the light is still in the shade of its own cloth where that turns away.
  // (Highlights keep farther away from where the shadow map's edges run.)
  float facing = dot(t.normal, toLight);
  float terminator = smoothstep(0.0, 0.3, facing), highlit = smoothstep(0.05, 0.6, facing);
  vec3 key = frame.keyColor.rgb * lit;
  float fill = max(0.5 + 0.5 * dot(normal, frame.toFillLight.xyz), 0.0);
  float through = TRANSMITTED * max(-facing, 0.0);
  vec3 light = albedo * matteShare() * (key * (normalLight * terminator * threads.light + through) + sky + fill * fill * open * frame.fillColor.rgb);

  vec3 fibres = frame.fabric.w * (0.05 + 0.95 * sqrt(albedo));
  return light + skyShine(t, threads, normal, toEye, albedo, share) + fibres * (key * highlit * sheenReflected(clamp(dot(normal, halfway), 0.0, 1.0), normalLight, normalEye) + sky * sheenAlbedo(normalEye));
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

#ifdef WOVEN
// A narrow highlight off the fibres, hardly dyed, in a wide one of light that has been inside of them (the lobes R and TRT of
// S. Marschner et al., "Light Scattering from Human Hair Fibers", 2003).
vec3 shineOf(vec2 along, float warp, vec3 albedo) {
  float gloss = frame.fabric.z, exponent = mix(5.0, 44.0, gloss);
  float narrow = threadShine(along, warp, 1.5 * exponent), wide = threadShine(along, warp, 0.3 * exponent);
  vec3 light = narrow * mix(vec3(0.30), sqrt(albedo), 0.5) + 0.45 * wide * sqrt(albedo);
  return light * (0.95 * gloss * gloss) * frame.keyColor.rgb;
}
#else
// Of a film: J. Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977, times (n + 8) / 8 for the energy.
vec3 shineOf(vec2 along, float warp, vec3 albedo) {
  float exponent = exp2(mix(2.0, 8.0, frame.fabric.z));
  float highlight = pow(max(1.0 - dot(along, along), 0.0), 0.5 * exponent);
  return highlight * (FILM_REFLECTED * (exponent + 8.0) / 8.0) * frame.keyColor.rgb;
}
#endif
