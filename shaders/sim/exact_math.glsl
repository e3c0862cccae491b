// The functions beyond + - * that a step may use; the twins of src/core/exact_math.h. Every intermediate is a named
// `precise` local, so that no driver may fuse or reorder it (docs/numeric-contract.md).

// 1 / sqrt(x) for 0 < x < 2^126 within 1.2 ulp, finite at 0.
float inverseSquareRoot(float x) {
  precise float y = uintBitsToFloat((0x5f330000u - (floatBitsToUint(x) >> 1)) & 0xfffff000u);
  precise float r = 1.0 - x * (y * y);
  precise float p = uintBitsToFloat(0x3ea74a11u);
  p = uintBitsToFloat(0x3e9e9e34u) + r * p;
  p = uintBitsToFloat(0x3ebffe5au) + r * p;
  p = uintBitsToFloat(0x3f000021u) + r * p;
  precise float result = y + y * (r * p);
  return result;
}

// 1 / x for 2^-120 < x < 2^124 within 1.5 ulp.
float reciprocal(float x) {
  precise float y = uintBitsToFloat(0x7eb504f3u - floatBitsToUint(x));
  y = y * (uintBitsToFloat(0x403255c8u) - uintBitsToFloat(0x3ff86fb4u) * (x * y));
  precise float r = 1.0 - x * y;
  precise float result = y + y * (r + r * r);
  return result;
}

float sumOfProducts(vec3 a, vec3 b) {
  precise float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}

vec3 crossProduct(vec3 a, vec3 b) {
  precise float x = a.y * b.z - a.z * b.y;
  precise float y = a.z * b.x - a.x * b.z;
  precise float z = a.x * b.y - a.y * b.x;
  return vec3(x, y, z);
}

// What state may hold: no denormal, no -0; below 2^-40 all is 0.
float canonical(float x) {
  return abs(x) < uintBitsToFloat(0x2b800000u) ? 0.0 : x;
}
vec3 canonical(vec3 v) {
  return vec3(canonical(v.x), canonical(v.y), canonical(v.z));
}
