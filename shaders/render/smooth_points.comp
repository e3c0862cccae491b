// Points of the smooth surface of a grid, with their normals and tangents: each invocation has the cell to the right of and
// below a particle, and evaluates the bicubic B-spline at the cell's points without its right and lower side. A lean surface
// (LEAN) takes all but the place from the particles: its triangles are partly those of the particles, and should not be shaded
// otherwise where they are divided. Between layers points are nearer to the triangles.
#include "render/cloth_piece.glsl"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(std430, binding = SMOOTH_POINTS_BINDING) writeonly buffer Points { vec4 points[]; };
layout(std430, binding = SMOOTH_NORMALS_BINDING) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = SMOOTH_TANGENTS_BINDING) writeonly buffer Tangents { vec4 tangents[]; };
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer ParticleNormals { vec4 particleNormals[]; };
layout(std430, binding = TANGENTS_OUT_BINDING) readonly buffer ParticleTangents { vec4 particleTangents[]; };
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = SMOOTH_SHARES_BINDING) readonly buffer Shares { float shares[]; };  // of the way from the triangles

#include "render/smooth_spline.glsl"

// Values at the corners of a cell, left to right, above and below.
vec4 between(mat4 corners, vec2 t) {
  return mix(mix(corners[0], corners[1], t.x), mix(corners[2], corners[3], t.x), t.y);
}
vec4 flatCorner(uint particle) { return vec4(positions[particle].xyz, shares[particle]); }

vec3 unit(vec3 v, vec3 otherwise) {
  float l = length(v);
  return l > 0.0 ? v / l : otherwise;
}

void store(uint point, vec4 place, vec3 normal, vec3 alongU, float strain) {
  normal = unit(normal, vec3(0, 1, 0));
  vec3 anyAcross = cross(normal, abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 0, 1));
  points[point] = vec4(place.xyz, 1.0);
  normals[point] = vec4(normal, place.w);
  tangents[point] = vec4(unit(alongU, normalize(anyAcross)), strain);
}

void main() {
  ivec2 size = ivec2(piece.columns, piece.rows), particle = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(particle, size))) return;
  int steps = int(piece.steps);
  // The last row and column have the lower and right sides of the cells before them.
  ivec2 cell = min(particle, size - 2);
  ivec2 count = ivec2(particle.x < size.x - 1 ? steps : 1, particle.y < size.y - 1 ? steps : 1);
  mat4 rows[4] = rowsAt(cell, 0u);
  uvec4 c = cornersOf(cell);
  mat4 flatCorners = mat4(0);
  if (piece.hasLayers > 0.0) flatCorners = mat4(flatCorner(c.x), flatCorner(c.y), flatCorner(c.z), flatCorner(c.w));
#ifdef LEAN
  mat4 cornerNormals = mat4(particleNormals[c.x], particleNormals[c.y], particleNormals[c.z], particleNormals[c.w]);
  mat4 cornerTangents = mat4(particleTangents[c.x], particleTangents[c.y], particleTangents[c.z], particleTangents[c.w]);
#else
  mat4 plain[4] = rowsAt(cell, 1u);
  vec4 strains = vec4(particleTangents[c.x].w, particleTangents[c.y].w, particleTangents[c.z].w, particleTangents[c.w].w);
#endif
  uint pointsInRow = uint(size.x - 1) * piece.steps + 1u;
  for (int i = 0; i < count.x; ++i) {
    float u = float(particle.x - cell.x) + float(i) / float(steps);
    vec4 basis = basisAt(u), slopes = slopesAt(u);
    mat4 places = mat4(rows[0] * basis, rows[1] * basis, rows[2] * basis, rows[3] * basis);
#ifndef LEAN
    mat4 plainPlaces = mat4(plain[0] * basis, plain[1] * basis, plain[2] * basis, plain[3] * basis);
    mat4 alongU = mat4(plain[0] * slopes, plain[1] * slopes, plain[2] * slopes, plain[3] * slopes);
#endif
    for (int j = 0; j < count.y; ++j) {
      float v = float(particle.y - cell.y) + float(j) / float(steps);
      uint point = piece.firstPoint + uint(particle.y * steps + j) * pointsInRow + uint(particle.x * steps + i);
      vec4 place = places * basisAt(v);
      if (piece.hasLayers > 0.0) {
        vec4 flatPlace = onTriangles(flatCorners, vec2(u, v));
        place.xyz = mix(flatPlace.xyz, place.xyz, flatPlace.w);
      }
#ifdef LEAN
      vec4 normal = between(cornerNormals, vec2(u, v)), tangent = between(cornerTangents, vec2(u, v));
      store(point, vec4(place.xyz, normal.w), normal.xyz, tangent.xyz, tangent.w);
#else
      vec3 right = (alongU * basisAt(v)).xyz, down = (plainPlaces * slopesAt(v)).xyz;
      float strain = mix(mix(strains.x, strains.y, u), mix(strains.z, strains.w, u), v);
      store(point, place, piece.front * cross(down, right), right, strain);
#endif
    }
  }
}
