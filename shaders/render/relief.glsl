// Height maps (src/render/textures.h): heights 0 to 1 in r, their change along u and v for one repeat in g and b.
#include "render/cloth_piece.glsl"
#include "render/frame.glsl"

layout(binding = HEIGHTS_UNIT) uniform sampler2D heights;

// Where on a texture that repeats along the longer side, and keeps its shape, a place of the cloth is.
vec2 textureAt(vec2 uv) { return uv * vec2(piece.width, piece.height) / piece.longer * frame.relief.z; }

// Slope along u and v, as rise over run.
vec2 slopeOfRelief(vec2 uv) {
  float repeats = frame.relief.z / piece.longer;  // in a metre
  return texture(heights, textureAt(uv)).gb * (frame.relief.y * repeats * frame.relief.x);
}
