// The bicubic B-spline of a grid, cell by cell. Before the include: `piece`.
layout(std430, binding = SMOOTH_CONTROLS_BINDING) readonly buffer Controls { vec4 controls[]; };

// The four cubic B-splines that are not 0 between two knots, and their derivatives.
vec4 basisAt(float t) {
  float s = 1.0 - t;
  return vec4(s * s * s, 4.0 - 3.0 * t * t * (1.0 + s), 4.0 - 3.0 * s * s * (1.0 + t), t * t * t) / 6.0;
}
vec4 slopesAt(float t) {
  float s = 1.0 - t;
  return vec4(-s * s, t * (3.0 * t - 4.0), s * (4.0 - 3.0 * s), t * t) / 2.0;
}

uvec4 cornersOf(ivec2 cell) {
  uint first = piece.firstParticle + uint(cell.y) * piece.columns + uint(cell.x);
  return first + uvec4(0u, 1u, piece.columns, piece.columns + 1u);
}

// The control points of a cell, of the first or the second kind (smooth_control.comp).
mat4[4] rowsAt(ivec2 cell, uint kind) {
  mat4 rows[4];
  for (uint j = 0u; j < 4u; ++j) {
    uint first = piece.firstControl + (kind * (piece.rows + 2u) + uint(cell.y) + j) * (piece.columns + 2u) + uint(cell.x);
    rows[j] = mat4(controls[first], controls[first + 1u], controls[first + 2u], controls[first + 3u]);
  }
  return rows;
}

// What the corners of a cell have, where its two triangles have it.
vec4 onTriangles(mat4 corners, vec2 t) {
  return t.x + t.y <= 1.0 ? corners[0] + t.x * (corners[1] - corners[0]) + t.y * (corners[2] - corners[0])
                          : corners[3] + (1.0 - t.x) * (corners[2] - corners[3]) + (1.0 - t.y) * (corners[1] - corners[3]);
}
