// Bending of a material: the energy 1/2 b |x(i-1) - 2 x(i) + x(i+1)|^2 of every three particles in a line, along rows and
// along columns (docs/physics.md).

// b (a - 2 m + c), the force on a and c; that on m, in the middle, is -2 times as large. Where the pins of a clamp end, the
// curvature of the first half cell shows at the last pin, half as large as it is: it counts twice.
vec3 bendingForce(vec4 a, vec4 m, vec4 c, float b) {
  bool endOfClamp = m.w == 0.0 && (a.w == 0.0) != (c.w == 0.0);
  precise float weighted = endOfClamp ? 2.0 * b : b;
  precise vec3 difference = (m.xyz - a.xyz) + (m.xyz - c.xyz);
  precise vec3 force = weighted * difference;
  return force;
}

// Over the three lines that particle i of `count` in a line of particles `stride` apart is in. `cut` says which of its
// springs are cut; a line is gone with any of the springs `before`, `around` or `after`.
vec3 addBendingLine(vec3 f, uint index, uint i, uint count, uint stride, float b, uint cut, uint before, uint around, uint after) {
  precise vec3 sum = f;
  vec4 x = positionAt(index);
  if (i >= 2u && (cut & before) == 0u)
    sum = sum + bendingForce(positionAt(index - 2u * stride), positionAt(index - stride), x, b);
  if (i >= 1u && i + 1u < count && (cut & around) == 0u)
    sum = sum - 2.0 * bendingForce(positionAt(index - stride), x, positionAt(index + stride), b);
  if (i + 2u < count && (cut & after) == 0u)
    sum = sum + bendingForce(x, positionAt(index + stride), positionAt(index + 2u * stride), b);
  return sum;
}

vec3 addBending(GridPoint p, vec3 f) {
  bool borderRow = p.row == 0u || p.row + 1u == step.rows;
  bool borderColumn = p.column == 0u || p.column + 1u == step.columns;
  precise float alongRow = borderRow ? 0.5 * step.bendAlongRow : step.bendAlongRow;
  precise float alongColumn = borderColumn ? 0.5 * step.bendAlongColumn : step.bendAlongColumn;
  uint cut = cutMaskOf(p.index);
  f = addBendingLine(f, p.index, p.column, step.columns, 1u, alongRow, cut, BENDING_LEFT, BENDING_ROW, BENDING_RIGHT);
  return addBendingLine(f, p.index, p.row, step.rows, step.columns, alongColumn, cut, BENDING_UPPER, BENDING_COLUMN, BENDING_LOWER);
}
