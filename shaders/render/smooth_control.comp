// Control points of the smooth surface of a grid: those of a bicubic B-spline, with a row and a column more on all sides.
// A B-spline lies inside of the bends of its control points. These are moved out by what it would lose,
// c = p - (p(i-1) - 2 p(i) + p(i+1)) / 6 along rows and columns: the spline through them comes by every particle to the
// fourth order of the spacing (cubics exactly), and damps what alternates from particle to particle. On a border it goes
// through the particles' own curve, and bends there as it does one particle further in. w: the hollow, just smoothed.
// Behind them come those for normals, the particles themselves: what the steps of a solver leave from particle to particle
// would otherwise flicker in highlights. The normals of spheres and cylinders are the same.
#include "render/cloth_piece.glsl"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = NORMALS_OUT_BINDING) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = SMOOTH_CONTROLS_BINDING) writeonly buffer Controls { vec4 controls[]; };

// Along a row or column: three neighbours, and what each of them counts.
struct Stencil {
  int first;
  vec3 weights;
};

// Of control point i of `count`, -1 to count.
Stencil stencilOf(int i, int count) {
  bool fromEnd = 2 * i >= count;
  int k = fromEnd ? count - 1 - i : i;
  vec3 weights = k > 0 ? vec3(-1, 8, -1) : k == 0 ? vec3(5, 2, -1) : vec3(17, -16, 5);
  if (count == 2) weights = k == 0 ? vec3(6, 0, 0) : vec3(12, -6, 0);
  int first = max(k - 1, 0);
  if (fromEnd) return Stencil(count - 3 - first, weights.zyx / 6.0);
  return Stencil(first, weights / 6.0);
}

// The particles, and beyond the border a parabola through three.
Stencil plainStencilOf(int i, int count) {
  bool fromEnd = 2 * i >= count, isBeyond = i < 0 || i >= count;
  if (!isBeyond) return Stencil(i, vec3(1, 0, 0));
  vec3 weights = count == 2 ? vec3(2, -1, 0) : vec3(3, -3, 1);
  return fromEnd ? Stencil(count - 3, weights.zyx) : Stencil(0, weights);
}

vec3 gathered(Stencil along, Stencil down, ivec2 size) {
  vec3 sum = vec3(0);
  for (int j = 0; j < 3; ++j) {
    uint row = piece.firstParticle + uint(clamp(down.first + j, 0, size.y - 1)) * piece.columns;
    vec3 inRow = vec3(0);
    for (int i = 0; i < 3; ++i)
      inRow += along.weights[i] * positions[row + uint(clamp(along.first + i, 0, size.x - 1))].xyz;
    sum += down.weights[j] * inRow;
  }
  return sum;
}

void main() {
  ivec2 size = ivec2(piece.columns, piece.rows), at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, size + 2))) return;
  ivec2 point = at - 1;
  ivec2 nearest = clamp(point, ivec2(0), size - 1);
  float hollow = normals[piece.firstParticle + uint(nearest.y) * piece.columns + uint(nearest.x)].w;
  uint control = piece.firstControl + uint(at.y) * (piece.columns + 2u) + uint(at.x);
  controls[control] = vec4(gathered(stencilOf(point.x, size.x), stencilOf(point.y, size.y), size), hollow);
  controls[control + (piece.columns + 2u) * (piece.rows + 2u)] =
      vec4(gathered(plainStencilOf(point.x, size.x), plainStencilOf(point.y, size.y), size), hollow);
}
