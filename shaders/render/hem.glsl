// The seam of a hem around the sheet, half a pixel wide at least so that it does not crawl. Factor for the albedo.
#include "render/cloth_piece.glsl"

const float HEM_WIDTH = 0.022;  // of the sheet's sides
const float SEAM_SHADE = 0.28;

float hem(vec2 uv) {
  if (piece.ring == 0u) return 1.0;  // a mesh, whose edges are not those of its texture
  vec2 inside = min(uv, 1.0 - uv);
  float fromSeam = abs(min(inside.x, inside.y) - HEM_WIDTH);
  float width = 0.0022 + 0.7 * fwidth(min(inside.x, inside.y));
  return 1.0 - SEAM_SHADE * (0.0022 / width + 0.15) * (1.0 - smoothstep(0.0, width * 1.5, fromSeam));
}
