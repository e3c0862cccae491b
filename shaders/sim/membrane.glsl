// What a triangle of a membrane does; the twin of src/solver/cpu/membrane_laws.h, which has the formulas. Membranes lie behind
// the hinges, in their buffer.

struct Membrane {
  uvec3 corners;
  vec3 restSquared;  // of the edges opposite them
  vec3 first;        // R, row by row
  vec2 second;
  float third;
};
Membrane membraneAt(uint number) {
  int row = int(number / 4u);
  uvec4 a = texelFetch(hinges, row), b = texelFetch(hinges, row + 1), c = texelFetch(hinges, row + 2);
  return Membrane(a.xyz, uintBitsToFloat(uvec3(a.w, b.xy)), uintBitsToFloat(uvec3(b.zw, c.x)), uintBitsToFloat(c.yz),
                  uintBitsToFloat(c.w));
}

// Edge k goes from corner k + 1 to corner k + 2.
vec3[3] edgesOf(vec3 a, vec3 b, vec3 c) {
  precise vec3 x = c - b;
  precise vec3 y = a - c;
  precise vec3 z = b - a;
  return vec3[3](x, y, z);
}

// R v.
vec3 timesRoots(Membrane m, vec3 v) {
  precise float x = (m.first.x * v.x + m.first.y * v.y) + m.first.z * v.z;
  precise float y = m.second.x * v.y + m.second.y * v.z;
  precise float z = m.third * v.z;
  return vec3(x, y, z);
}
// R^T R v.
vec3 timesMatrix(Membrane m, vec3 v) {
  vec3 w = timesRoots(m, v);
  precise float x = m.first.x * w.x;
  precise float y = m.first.y * w.x + m.second.x * w.y;
  precise float z = (m.first.z * w.x + m.second.y * w.y) + m.third * w.z;
  return vec3(x, y, z);
}

// e = (l^2 - L^2) / 2, of edges d.
vec3 strainsOf(Membrane m, vec3 d[3]) {
  precise float x = 0.5 * (sumOfProducts(d[0], d[0]) - m.restSquared.x);
  precise float y = 0.5 * (sumOfProducts(d[1], d[1]) - m.restSquared.y);
  precise float z = 0.5 * (sumOfProducts(d[2], d[2]) - m.restSquared.z);
  return vec3(x, y, z);
}

// The force on a corner where edge k pulls by pulls[k].
vec3 pullAt(uint corner, vec3 pulls[3]) {
  uint next = corner == 2u ? 0u : corner + 1u, last = corner == 0u ? 2u : corner - 1u;
  precise vec3 pull = pulls[last] - pulls[next];
  return pull;
}

// The tensions that the implicit integrator takes into its matrix.
vec3 positiveTensions(Membrane m, vec3 d[3]) {
  vec3 t = canonical(timesMatrix(m, strainsOf(m, d)));
  precise float sum = (t.x + t.y) + t.z;
  precise float determinant = (t.x * t.y + t.y * t.z) + t.z * t.x;
  bool pulls = sum > 0.0 && determinant > 0.0;
  return pulls ? t : vec3(t.x > 0.0 ? t.x : 0.0, t.y > 0.0 ? t.y : 0.0, t.z > 0.0 ? t.z : 0.0);
}
