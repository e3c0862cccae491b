// The triangles' sides: lines between neighbours, finer ones along the diagonals, as wide on the screen at any distance.
// Where cells are smaller than pixels, lines give way to the tone that they have on average.
#include "render/cloth_piece.glsl"
#include "render/frame.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float WIDTH = 1.25, DIAGONAL_WIDTH = 0.7;  // [pixels]

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

// How much of the pixel is covered by lines at whole numbers of `lattice`.
float cover(float lattice, float width) {
  float perPixel = max(length(vec2(dFdx(lattice), dFdy(lattice))), 1e-6);
  float fromLine = abs(fract(lattice - 0.5) - 0.5) / perPixel;
  float line = clamp(0.5 * width + 0.5 - fromLine, 0.0, 1.0) * min(width, 1.0);
  return mix(line, min(width * perPixel, 1.0), smoothstep(0.25, 0.6, perPixel));
}

void main() {
  vec2 lattice = surface.uv * vec2(piece.columns - 1u, piece.rows - 1u);
  float sides = max(cover(lattice.x, WIDTH), cover(lattice.y, WIDTH));
  float opacity = max(sides, 0.75 * cover(lattice.x + piece.front * lattice.y, DIAGONAL_WIDTH));
  if (piece.ring == 0u) opacity = 1.0;  // a mesh is drawn as lines
  float facing = abs(dot(normalize(surface.normal), normalize(frame.eye.xyz - surface.position)));
  vec3 light = albedoOfSide() * (0.55 + 0.6 * facing);
  color = vec4(canvasFromLight(light) * opacity, opacity);
}
