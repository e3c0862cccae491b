// The triangles of a grid, each cell divided along the diagonal whose ends have normals that are more alike: light that
// is worked out at vertices shows any other as a saw along a fold. Without cuts.
#include "render/cloth_piece.glsl"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = DIAGONALS_BINDING) writeonly buffer Indices { uint indices[]; };  // six a cell

const float LEAST_DIFFERENCE = 0.001;  // of cosines; where cloth is flat, diagonals stay as the springs have them

float likeness(uint a, uint b) { return dot(normals[a].xyz, normals[b].xyz); }

void put(uint at, uint a, uint b, uint c) {
  indices[at] = a;
  indices[at + 1u] = b;
  indices[at + 2u] = c;
}

void main() {
  uvec2 cell = gl_GlobalInvocationID.xy;
  uint columns = piece.columns - 1u;
  if (cell.x >= columns || cell.y >= piece.rows - 1u) return;
  uint a = piece.firstParticle + cell.y * piece.columns + cell.x, b = a + 1u, c = a + piece.columns, d = c + 1u;
  uint at = 6u * (cell.y * columns + cell.x);
  bool isAlongA = likeness(a, d) > likeness(b, c) + LEAST_DIFFERENCE;
  put(at, a, c, isAlongA ? d : b);
  put(at + 3u, isAlongA ? a : b, isAlongA ? d : c, isAlongA ? b : d);
}
