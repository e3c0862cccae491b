// Symmetric 3 x 3 matrices; the twin of src/solver/cpu/symmetric.h.
struct Symmetric {
  vec3 diagonal;  // xx, yy, zz
  vec3 others;    // xy, xz, yz
};

Symmetric sumOf(Symmetric a, Symmetric b) {
  precise vec3 diagonal = a.diagonal + b.diagonal;
  precise vec3 others = a.others + b.others;
  return Symmetric(diagonal, others);
}

// s v v^T
Symmetric outerProduct3(float s, vec3 v) {
  precise vec3 w = s * v;
  precise vec3 diagonal = w * v;
  precise vec3 others = w.xxy * v.yzz;
  return Symmetric(diagonal, others);
}

vec3 timesVector(Symmetric a, vec3 v) {
  precise float x = (a.diagonal.x * v.x + a.others.x * v.y) + a.others.y * v.z;
  precise float y = (a.others.x * v.x + a.diagonal.y * v.y) + a.others.z * v.z;
  precise float z = (a.others.y * v.x + a.others.z * v.y) + a.diagonal.z * v.z;
  return vec3(x, y, z);
}

// a = L D L^T: l21, l31, l32 and 1/d1, 1/d2, 1/d3.
struct Factors {
  vec3 lower;
  vec3 inverse;
};

float larger(float a, float b) { return a < b ? b : a; }

// Pivots are at least 1e-6 of the trace: below, binary32 holds no more of them. Without a trace, all is 0.
Factors factorize(Symmetric a) {
  precise float least = uintBitsToFloat(0x358637bdu) * ((a.diagonal.x + a.diagonal.y) + a.diagonal.z);
  if (!(least > uintBitsToFloat(0x21800000u))) return Factors(vec3(0.0), vec3(0.0));  // 2^-60
  precise float i1 = reciprocal(larger(a.diagonal.x, least));
  precise float l21 = a.others.x * i1;
  precise float l31 = a.others.y * i1;
  precise float second = a.diagonal.y - l21 * a.others.x;
  precise float i2 = reciprocal(larger(second, least));
  precise float rest = a.others.z - l21 * a.others.y;
  precise float l32 = rest * i2;
  precise float third = (a.diagonal.z - l31 * a.others.y) - l32 * rest;
  precise float i3 = reciprocal(larger(third, least));
  return Factors(vec3(l21, l31, l32), vec3(i1, i2, i3));
}

// a^-1 r
vec3 solveFor(Factors a, vec3 r) {
  precise float y2 = r.y - a.lower.x * r.x;
  precise float y3 = (r.z - a.lower.y * r.x) - a.lower.z * y2;
  precise float z3 = a.inverse.z * y3;
  precise float z2 = a.inverse.y * y2 - a.lower.z * z3;
  precise float z1 = (a.inverse.x * r.x - a.lower.x * z2) - a.lower.y * z3;
  return vec3(z1, z2, z3);
}
