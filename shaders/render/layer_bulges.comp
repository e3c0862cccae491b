// How far the smooth surface would leave the triangles of particles in their middle: of a grid, or (PATCHES) of a mesh or a cut
// grid.
#include "render/cloth_piece.glsl"

layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = LAYER_BULGES_BINDING) writeonly buffer Bulges { vec4 bulges[]; };

#ifdef PATCHES
layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer ParticleNormals { vec4 particleNormals[]; };
layout(std430, binding = LAYER_TRIANGLES_BINDING) readonly buffer Triangles { uint corners[]; };
#include "render/patch_point.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= piece.triangles) return;
  uint triangle = piece.firstTriangle + gl_GlobalInvocationID.x;
  uvec3 c = uvec3(corners[3u * triangle], corners[3u * triangle + 1u], corners[3u * triangle + 2u]);
  vec3 bulge = onPatch(c, vec3(1.0 / 3.0)) - (positions[c.x].xyz + positions[c.y].xyz + positions[c.z].xyz) / 3.0;
  bulges[triangle] = vec4(bulge, length(bulge));
}
#else
layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
#include "render/smooth_spline.glsl"

vec4 flatCorner(uint particle) { return vec4(positions[particle].xyz, 0.0); }

void main() {
  ivec2 size = ivec2(piece.columns, piece.rows), cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, size - 1))) return;
  mat4 rows[4] = rowsAt(cell, 0u);
  uvec4 c = cornersOf(cell);
  mat4 flatCorners = mat4(flatCorner(c.x), flatCorner(c.y), flatCorner(c.z), flatCorner(c.w));
  for (int k = 0; k < 2; ++k) {
    float t = float(k + 1) / 3.0;
    vec4 basis = basisAt(t);
    vec3 place = (mat4(rows[0] * basis, rows[1] * basis, rows[2] * basis, rows[3] * basis) * basis).xyz;
    vec3 bulge = place - onTriangles(flatCorners, vec2(t)).xyz;
    bulges[piece.firstTriangle + 2u * uint(cell.y * (size.x - 1) + cell.x) + uint(k)] = vec4(bulge, length(bulge));
  }
}
#endif
