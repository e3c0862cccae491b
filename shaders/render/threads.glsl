// The threads of woven cloth and the loops of knits. Their pictures' mipmaps are the mean over what a pixel covers, so that
// threads fade into the colour and the normal of the whole cloth before they are too fine to be drawn.
#include "render/cloth_piece.glsl"
#include "render/frame.glsl"

#ifdef WOVEN
layout(binding = WEAVE_UNIT) uniform sampler2D weave;
#endif

const float SLOPE_RANGE = 3.0;      // of the weaves' pictures (tools/make_textures)
const float SMALLEST_MIPMAP = 32.0;  // a level beyond the last means the last
const float FLATTENED = 0.5;        // threads are pressed flat, compared with those pictures
const float MOST_OBLIQUE = 16.0;    // the length of what a pixel covers over its width, as far as that is followed

struct Threads {
  vec2 slope;   // of their surface, along u and v
  float light;  // that reaches down between them
  float warp;   // part of the light that falls on the warp, the threads along v
  float dye;    // of the warp, about 1
};

#ifdef WOVEN
#ifndef LIT_AT_VERTICES
float hashOf(ivec2 cell) {
  uint h = uint(cell.x) * 0x9E3779B1u ^ uint(cell.y) * 0x85EBCA77u;
  h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12u)) * 0x297A2D39u;
  return float(h >> 8u) / 16777216.0;
}

// Smooth between values at whole numbers, less its mean.
float valueNoise(vec2 place) {
  ivec2 cell = ivec2(floor(place));
  vec2 t = fract(place);
  t = t * t * (3.0 - 2.0 * t);
  float low = mix(hashOf(cell), hashOf(cell + ivec2(1, 0)), t.x);
  float high = mix(hashOf(cell + ivec2(0, 1)), hashOf(cell + ivec2(1, 1)), t.x);
  return mix(low, high, t.y) - 0.5;
}

// Streaks along the warp, of single threads and of some together. Each size fades out where a pixel covers it (the clamping
// of A. Norton, A. Rockwood, P. Skolmoski, "Clamping: A Method of Antialiasing Textured Surfaces...", 1982).
float dyeOf(vec2 threads) {
  const vec2 SINGLE = vec2(1.0, 24.0), SOME = vec2(5.0, 110.0), MANY = vec2(26.0, 300.0);  // threads across and along
  if (frame.yarns.z <= 0.0) return 1.0;
  float covered = fwidth(threads.x);
  vec3 seen = 1.0 - smoothstep(vec3(0.25), vec3(1.0), covered / vec3(SINGLE.x, SOME.x, MANY.x));
  float sum = 1.1 * seen.x * valueNoise(threads / SINGLE) + 0.9 * seen.y * valueNoise(threads / SOME + 17.0);
  return 1.0 + frame.yarns.z * (sum + 0.6 * seen.z * valueNoise(threads / MANY + 31.0));
}
#endif

// The weave at a place in its repeats.
vec4 storedAt(vec2 place) {
#if defined(LIT_AT_VERTICES)
  return textureLod(weave, place, SMALLEST_MIPMAP);  // threads that are much finer than a triangle, as a mean
#elif defined(EXPOSURE)
  // Exposures lie side by side in what the pixel covers: each needs only the mean over half the width of that, and the rest
  // is the mean of the exposures. So threads fade along each direction by what is covered in it.
  vec2 right = dFdx(place), up = dFdy(place);
  float longer = max(max(length(right), length(up)), 1e-9);
  float width = max(abs(right.x * up.y - right.y * up.x) / longer, longer / MOST_OBLIQUE);
  return textureLod(weave, place, log2(0.5 * width * float(textureSize(weave, 0).x)));
#else
  // One mipmap smaller than usual: the weave repeats every two threads, which a pixel of one thread would turn into moire.
  return texture(weave, place, 1.0);
#endif
}
#endif

bool isKnit() { return frame.yarns.w > 0.0; }

Threads threadsAt(vec2 uv, float side) {
#ifdef WOVEN
  vec2 place = uv * vec2(piece.width, piece.height) * frame.fabric.xy;
  // The weft floats on the reverse as the warp does on the face.
  bool isTurned = side < 0.0 && !isKnit();
  vec4 stored = storedAt(isTurned ? place.yx : place);
  vec2 slope = (stored.rg * 2.0 - 256.0 / 255.0) * (SLOPE_RANGE * FLATTENED * frame.relief.x);
  if (isTurned) slope = slope.yx;
#ifdef LIT_AT_VERTICES
  float dye = 1.0;
#else
  float dye = dyeOf(place * frame.yarns.xy);
#endif
  float warp = stored.a / max(stored.b, 0.01);
  if (isKnit()) {  // its reverse has rows of loops, which rise along v alone as far as is stored
    if (side < 0.0) slope = vec2(0.0, (stored.a * 2.0 - 256.0 / 255.0) * (SLOPE_RANGE * FLATTENED * frame.relief.x));
    warp = 0.5;
  }
  return Threads(slope, stored.b, side > 0.0 ? warp : 1.0 - warp, dye);
#else
  return Threads(vec2(0), 1.0, 0.5, 1.0);
#endif
}

// Highlights of fibres along u (weft) and v (warp), of which the direction halfway to the light has these parts.
float threadShine(vec2 along, float warp, float exponent) {
  vec2 shine = pow(max(1.0 - along * along, 0.0), vec2(exponent));
  return mix(shine.x, shine.y, warp);
}
