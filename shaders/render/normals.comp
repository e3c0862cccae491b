// Smooth normals: each particle gathers the area-weighted normals of its up to six triangles. w carries the curvature
// of the cloth along the normal [1/m], positive in the hollow of a fold, for its darker shading.
#include "shared/render_layout.h"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(std140, binding = NORMALS_GRID_BINDING) uniform NormalsGridBlock { NormalsGrid grid; };
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = NORMALS_OUT_BINDING) writeonly buffer Normals { vec4 normals[]; };

vec3 positionAt(ivec2 point) {
  return positions[grid.firstParticle + uint(point.y) * grid.columns + uint(point.x)].xyz;
}

// The neighbour's offset; zero beyond the border, so that triangles which do not exist add nothing.
vec3 toNeighbour(ivec2 point, vec3 here, int columns, int rows) {
  ivec2 other = point + ivec2(columns, rows);
  bool exists = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(grid.columns, grid.rows)));
  return exists ? positionAt(other) - here : vec3(0);
}

// Second difference along one axis of the grid over the square of its spacing [1/m]; 0 at the border.
vec3 curvature(vec3 before, vec3 after) {
  float spacing2 = 0.5 * (dot(before, before) + dot(after, after));
  return before == vec3(0) || after == vec3(0) ? vec3(0) : (before + after) / spacing2;
}

void main() {
  ivec2 point = ivec2(gl_GlobalInvocationID.xy);
  if (point.x >= int(grid.columns) || point.y >= int(grid.rows)) return;
  vec3 here = positionAt(point);
  vec3 right = toNeighbour(point, here, 1, 0), left = toNeighbour(point, here, -1, 0);
  vec3 lower = toNeighbour(point, here, 0, 1), upper = toNeighbour(point, here, 0, -1);
  vec3 lowerLeft = toNeighbour(point, here, -1, 1), upperRight = toNeighbour(point, here, 1, -1);

  // The fan of triangles around the point; the diagonals run from upper right to lower left.
  vec3 sum = cross(lower, right) + cross(lowerLeft, lower) + cross(left, lowerLeft);
  sum += cross(upper, left) + cross(upperRight, upper) + cross(right, upperRight);
  float area = length(sum);
  vec3 normal = area > 0.0 ? sum / area : vec3(0, 1, 0);
  float hollow = dot(curvature(left, right) + curvature(upper, lower), normal);
  normals[grid.firstParticle + uint(point.y) * grid.columns + uint(point.x)] = vec4(normal, hollow);
}
