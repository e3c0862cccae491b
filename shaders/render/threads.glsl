// The threads of woven cloth.
#include "render/cloth_piece.glsl"
#include "render/frame.glsl"

#ifdef WOVEN
layout(binding = WEAVE_UNIT) uniform sampler2D weave;
#endif

const float SLOPE_RANGE = 3.0;      // of the weaves' pictures (tools/make_textures)
const float SMALLEST_MIPMAP = 32.0;  // a level beyond the last means the last
const float FLATTENED = 0.5;        // threads are pressed flat, compared with those pictures

struct Threads {
  vec2 slope;   // of their surface, along u and v
  float light;  // that reaches down between them
  float warp;   // part of the surface that is warp, the threads along v
};

Threads threadsAt(vec2 uv, float side) {
#ifdef WOVEN
#ifdef LIT_AT_VERTICES
  vec4 stored = textureLod(weave, uv, SMALLEST_MIPMAP);  // threads that are much finer than a triangle, as a mean
#else
  // One mipmap smaller than usual: the weave repeats every two threads, which a pixel of one thread would turn into moire.
  vec4 stored = texture(weave, uv * vec2(piece.width, piece.height) * frame.fabric.x, 1.0);
#endif
  vec2 slope = (stored.rg * 2.0 - 256.0 / 255.0) * (SLOPE_RANGE * FLATTENED * frame.relief.x);
  return Threads(slope, stored.b, side > 0.0 ? stored.a : 1.0 - stored.a);  // what is below on one side is above on the other
#else
  return Threads(vec2(0), 1.0, 0.5);
#endif
}

// Highlights of fibres along u (weft) and v (warp), of which the direction halfway to the light has these parts.
float threadShine(vec2 along, float warp, float exponent) {
  vec2 shine = pow(max(1.0 - along * along, 0.0), vec2(exponent));
  return mix(shine.x, shine.y, warp);
}
