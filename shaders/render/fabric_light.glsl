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

const float TRANSMITTED = 0.14;     // part of the key light that comes out at the other side
const float HOLLOW_SHADE = 1.7;
const float SHINE = 0.6;            // part of the light that the glossiest threads reflect along themselves, not all around
const float NARROW_SHINE = 0.5;     // of it, in the narrow lobe
const float LOBE_SCALE = 0.39;      // keeps the lobes' energy: measured (tests/gl/render/furnace_gl_test.cpp)
const float DEEP_IN_PILE = 0.5;     // part of the light that a pile does not let out again
const float UNDYED = 0.006;         // part of the light that threads reflect off their fibres' surface
const float FILM_REFLECTED = 0.04;  // of light from straight ahead, at a refractive index of 1.5

vec3 directionToEye(vec3 position) { return normalize(frame.eye.xyz - position); }

// Between the threads of the warp, those of the weft show.
vec3 albedoOfThreads(vec3 dye, float warp) {
  vec3 dyed = mix(mix(dye, frame.weft.rgb, frame.weft.w), dye, warp);
#ifdef WOVEN
  return mix(dyed, vec3(1), UNDYED * (1.0 - frame.fabric.z));  // that of glossy ones is their shine
#else
  return dyed;
#endif
}

// The reverse may be duller: of satin the weft is there.
float glossOf(float side) { return frame.fabric.z * (side > 0.0 ? 1.0 : frame.relief.w); }

// The part of the light that is reflected along the threads.
float shineShare(float gloss) { return SHINE * gloss * gloss; }

// Of light that has been inside of fibres and comes out again on the side from where it came.
vec3 dyedShine(vec3 albedo) { return mix(albedo, sqrt(albedo), 0.2); }
vec3 shineTint(vec3 albedo) { return mix(dyedShine(albedo), vec3(0.5), 0.12); }

// What a film reflects at its surface (C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994).
float filmReflected(float normalEye) {
  float grazing = 1.0 - clamp(normalEye, 0.0, 1.0), grazing2 = grazing * grazing;
  return FILM_REFLECTED + (1.0 - FILM_REFLECTED) * grazing2 * grazing2 * grazing;
}

// The sheen's colour and strength: fibres on the surface hardly dye what they reflect.
vec3 sheenTint(vec3 albedo, float side) {
  float fibres = frame.fabric.w * (side < 0.0 ? 1.0 - 0.8 * frame.pile : 1.0);  // no pile on the reverse
  return fibres * mix(sqrt(albedo), vec3(1), 0.05);
}

// What is left for the matte threads below the sheen and the shine, or below the surface of a film, so that no more light
// is sent back than comes (A. C. Estevez, C. Kulla, 2017, as in charlie.glsl).
float matteShare(vec3 sheen, float gloss, float normalEye, float side) {
#ifdef WOVEN
  float above = side < 0.0 ? 1.0 : 1.0 - DEEP_IN_PILE * frame.pile;
  return above * (1.0 - shineShare(gloss)) * (1.0 - max(max(sheen.r, sheen.g), sheen.b) * sheenAlbedo(normalEye));
#else
  return 1.0 - filmReflected(normalEye);
#endif
}

// What comes from the sky without being dyed as matte light is: along the threads, or off a film. A bundle of fibres has
// normals all around it: the one that faces the eye most is that of its reflection.
vec3 skyShine(TangentFrame t, Threads threads, vec3 normal, vec3 toEye, vec3 albedo, float gloss, float share) {
#ifdef WOVEN
  vec3 fibres = threads.warp > 0.5 ? t.v : t.u;
  vec3 ofFibres = normalize(toEye - dot(toEye, fibres) * fibres + 0.3 * normal);
  return skyIrradiance(reflect(-toEye, ofFibres)) * (share * shineShare(gloss) * max(threads.warp, 1.0 - threads.warp)) * shineTint(albedo);
#else
  return skyIrradiance(reflect(-toEye, normal)) * (share * filmReflected(dot(normal, toEye)) * mix(0.3, 1.0, gloss));
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
  float gloss = glossOf(side);
  vec3 fibres = sheenTint(albedo, side);
  vec3 light = albedo * matteShare(fibres, gloss, normalEye, side) * (key * ((1.0 - TRANSMITTED) * normalLight * terminator * threads.light + through) + sky + fill * fill * share * frame.fillColor.rgb);
  return light + skyShine(t, threads, normal, toEye, albedo, gloss, share) + fibres * (key * highlit * sheenReflected(clamp(dot(normal, halfway), 0.0, 1.0), normalLight, normalEye) + sky * sheenAlbedo(normalEye));
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
// Over what it sends back of light from all around, which narrows as one over the root of the exponent.
float lobeShine(vec2 along, float warp, float exponent) {
  return threadShine(along, warp, exponent) * (LOBE_SCALE * sqrt(exponent + 0.8));
}

// A narrow highlight off the fibres, hardly dyed, in a wide one of light that has been inside of them (the lobes R and TRT of
// S. Marschner et al., "Light Scattering from Human Hair Fibers", 2003).
vec3 shineOf(vec2 along, float warp, vec3 albedo, float side) {
  float gloss = glossOf(side), exponent = mix(5.0, 44.0, gloss);
#ifdef LIT_AT_VERTICES
  // Cheaper than four powers: ln(1 - x) is -x - x^2 / 2 nearly, and the narrow lobe nearly the 4.5th power of the wide one.
  vec2 squares = along * along;
  vec2 lobes = exp2(-1.442695 * 0.45 * exponent * (squares + 0.5 * squares * squares)), fourth = lobes * lobes * lobes * lobes;
  float ofWide = mix(lobes.x, lobes.y, warp) * (LOBE_SCALE * sqrt(0.45 * exponent + 0.8));
  vec2 narrowLobes = fourth * sqrt(lobes);
  float ofNarrow = mix(narrowLobes.x, narrowLobes.y, warp) * (LOBE_SCALE * sqrt(2.0 * exponent + 0.8));
#else
  float ofNarrow = lobeShine(along, warp, 2.0 * exponent), ofWide = lobeShine(along, warp, 0.45 * exponent);
#endif
  vec3 narrow = ofNarrow * mix(sqrt(albedo), vec3(0.5), 0.3);
  vec3 wide = ofWide * dyedShine(albedo);
  return mix(wide, narrow, NARROW_SHINE) * shineShare(gloss) * frame.keyColor.rgb;
}
#else
// Of a film: J. Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977, times (n + 8) / 8 for the energy.
vec3 shineOf(vec2 along, float warp, vec3 albedo, float side) {
  float exponent = exp2(mix(2.0, 8.0, frame.fabric.z));
  float highlight = pow(max(1.0 - dot(along, along), 0.0), 0.5 * exponent);
  return highlight * (FILM_REFLECTED * (exponent + 8.0) / 8.0) * frame.keyColor.rgb;
}
#endif
