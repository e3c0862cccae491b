// Smooth normals: each particle gathers the area-weighted normals of its up to six triangles; tangents along u beside
// them. The normal's w says how far the cloth around rises above the tangent plane (the mean sine, -1 to 1): the hollows
// of folds are shaded darker by it. The tangent's w is the strain, where a model asks for it.
#include "render/cloth_piece.glsl"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(binding = NORMALS_POSITIONS_UNIT) uniform samplerBuffer positions;  // a texel a particle
layout(std430, binding = NORMALS_OUT_BINDING) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = TANGENTS_OUT_BINDING) writeonly buffer Tangents { vec4 tangents[]; };

vec3 placeOf(uint particle) { return texelFetch(positions, int(particle)).xyz; }
uint particleAt(ivec2 point) { return piece.firstParticle + uint(point.y) * piece.columns + uint(point.x); }

bool isOnGrid(ivec2 point) {
  return all(greaterThanEqual(point, ivec2(0))) && all(lessThan(point, ivec2(piece.columns, piece.rows)));
}

#include "render/cuts.glsl"
#include "render/strain.glsl"

// The neighbour's offset; zero beyond the border, so that triangles which do not exist add nothing.
vec3 toNeighbour(ivec2 point, vec3 here, int columns, int rows) {
  ivec2 other = point + ivec2(columns, rows);
  return isOnGrid(other) ? placeOf(particleAt(other)) - here : vec3(0);
}

// The mean sine of the elevation of the points on a ring around `point`, seen from it. What a cut has set free does not
// count once it is farther away than cloth could be.
float hollowAt(ivec2 point, vec3 here, vec3 normal) {
  float sum = 0.0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      vec3 d = toNeighbour(point, here, column * int(piece.ring), row * int(piece.ring));
      float l = length(d);
#ifdef CUTS
      d *= clamp(3.0 - l / piece.reach, 0.0, 1.0);
#endif
      sum += dot(d, normal) / max(l, 1e-9);
    }
  }
  return sum / 8.0;
}

void main() {
  ivec2 point = ivec2(gl_GlobalInvocationID.xy);
  if (point.x >= int(piece.columns) || point.y >= int(piece.rows)) return;
  vec3 here = placeOf(particleAt(point));
  vec3 right = toNeighbour(point, here, 1, 0), left = toNeighbour(point, here, -1, 0);
  vec3 lower = toNeighbour(point, here, 0, 1), upper = toNeighbour(point, here, 0, -1);
  vec3 lowerLeft = toNeighbour(point, here, -1, 1), upperRight = toNeighbour(point, here, 1, -1);

  // The fan of triangles around the point; the diagonals run from upper right to lower left.
  vec3 sum = vec3(0);
  if (hasUpperTriangle(point)) sum += cross(lower, right);
  if (hasLowerTriangle(point + ivec2(-1, 0))) sum += cross(lowerLeft, lower);
  if (hasUpperTriangle(point + ivec2(-1, 0))) sum += cross(left, lowerLeft);
  if (hasLowerTriangle(point + ivec2(-1, -1))) sum += cross(upper, left);
  if (hasUpperTriangle(point + ivec2(0, -1))) sum += cross(upperRight, upper);
  if (hasLowerTriangle(point + ivec2(0, -1))) sum += cross(right, upperRight);
  float area = length(sum);
  vec3 normal = area > 0.0 ? piece.front * sum / area : vec3(0, 1, 0);
  normals[particleAt(point)] = vec4(normal, hollowAt(point, here, normal));

  if (isCut(point + ivec2(1, 0), TO_LEFT)) right = vec3(0);
  if (isCut(point, TO_LEFT)) left = vec3(0);
  vec3 along = right - left;
  along -= dot(along, normal) * normal;
  float l = length(along);
  vec3 anyAcross = cross(normal, abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1));
  tangents[particleAt(point)] = vec4(l > 0.0 ? along / l : normalize(anyAcross), strainAt(point, here));
}
