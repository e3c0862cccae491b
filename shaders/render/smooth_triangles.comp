// The triangles of a lean surface that have an area, one behind the other in the order of their cells: each invocation has
// the eight of a cell, of points that smooth_choose.comp has moved. Each work group counts its own (COUNT); then it stores
// them behind those of the groups before it. The last one knows how many there are.
#include "render/cloth_piece.glsl"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = SMOOTH_PLACES_BINDING) readonly buffer Places { uint places[]; };
layout(std430, binding = SMOOTH_COUNTS_BINDING) buffer Counts { uint counts[]; };

shared uint kept[SMOOTH_GROUP];

// Of the 3 x 3 points of a cell, row by row.
const uvec3 TRIANGLES[8] = uvec3[8](uvec3(0, 3, 1), uvec3(1, 3, 4), uvec3(1, 4, 2), uvec3(2, 4, 5), uvec3(3, 6, 4),
                                    uvec3(4, 6, 7), uvec3(4, 7, 5), uvec3(5, 7, 8));

struct Cell {
  uint points[9];
  bool exists;
};

Cell ownCell() {
  Cell cell;
  uint cells = piece.columns - 1u, number = gl_GlobalInvocationID.x;
  uint column = number % cells, row = number / cells, pointsInRow = 2u * cells + 1u;
  cell.exists = row + 1u < piece.rows;
  for (uint k = 0u; k < 9u; ++k) {
    uint point = piece.firstPoint + (2u * row + k / 3u) * pointsInRow + 2u * column + k % 3u;
    cell.points[k] = cell.exists ? places[point] : 0u;
  }
  return cell;
}

uvec3 triangleOf(Cell cell, uint k) {
  uvec3 corners = TRIANGLES[k];
  return uvec3(cell.points[corners.x], cell.points[corners.y], cell.points[corners.z]);
}
bool hasArea(uvec3 t) { return t.x != t.y && t.y != t.z && t.z != t.x; }

uint countOf(Cell cell) {
  uint count = 0u;
  for (uint k = 0u; k < 8u; ++k) count += hasArea(triangleOf(cell, k)) ? 1u : 0u;
  return count;
}

#ifdef COUNT
void main() {
  uint own = gl_LocalInvocationIndex;
  kept[own] = countOf(ownCell());
  barrier();
  if (own > 0u) return;
  uint sum = 0u;
  for (uint k = 0u; k < SMOOTH_GROUP; ++k) sum += kept[k];
  counts[gl_WorkGroupID.x] = sum;
}
#else
layout(std430, binding = SMOOTH_KEPT_BINDING) writeonly buffer Kept { uint indices[]; };
layout(std430, binding = SMOOTH_COMMAND_BINDING) writeonly buffer Command { uint command[]; };

shared uint before[SMOOTH_GROUP];

void main() {
  uint own = gl_LocalInvocationIndex, group = gl_WorkGroupID.x;
  Cell cell = ownCell();
  kept[own] = countOf(cell);
  uint sum = 0u;
  for (uint other = own; other < group; other += SMOOTH_GROUP) sum += counts[other];
  before[own] = sum;
  barrier();
  uint place = 0u;
  for (uint k = 0u; k < SMOOTH_GROUP; ++k) place += before[k] + (k < own ? kept[k] : 0u);
  if (group + 1u == gl_NumWorkGroups.x && own + 1u == SMOOTH_GROUP) command[0] = 3u * (place + kept[own]);
  for (uint k = 0u; k < 8u; ++k) {
    uvec3 t = triangleOf(cell, k);
    if (!hasArea(t)) continue;
    if (piece.front < 0.0) t = t.xzy;
    indices[3u * place] = t.x;
    indices[3u * place + 1u] = t.y;
    indices[3u * place + 2u] = t.z;
    ++place;
  }
}
#endif
