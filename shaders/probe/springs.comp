// Springs without memory traffic: SPRINGS forces by Hooke's law an invocation. ARITHMETIC: 0 exact, as the passes compute
// (docs/numeric-contract.md), 1 the same formulas, in which the driver may fuse products and sums, 2 with its own
// inversesqrt().
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly restrict buffer Forces { vec4 forces[]; };
#include "sim/exact_math.glsl"

#if ARITHMETIC == 0
vec3 springForce(vec3 d) {
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float len = lengthSquared * inverseLength;
  precise float scale = (5000.0 * (len - 0.5)) * inverseLength;
  precise vec3 force = scale * d;
  return force;
}
#else
float looseInverseSquareRoot(float x) {
#if ARITHMETIC == 2
  return inversesqrt(x);
#else
  float y = uintBitsToFloat((0x5f330000u - (floatBitsToUint(x) >> 1)) & 0xfffff000u);
  float r = 1.0 - x * (y * y);
  float p = uintBitsToFloat(0x3e9e9e34u) + r * uintBitsToFloat(0x3ea74a11u);
  p = uintBitsToFloat(0x3ebffe5au) + r * p;
  p = uintBitsToFloat(0x3f000021u) + r * p;
  return y + y * (r * p);
#endif
}
vec3 springForce(vec3 d) {
  float lengthSquared = dot(d, d);
  float inverseLength = looseInverseSquareRoot(lengthSquared);
  float scale = (5000.0 * (lengthSquared * inverseLength - 0.5)) * inverseLength;
  return scale * d;
}
#endif

void main() {
  vec3 place = vec3(gl_GlobalInvocationID.x & 1023u, gl_GlobalInvocationID.x >> 10, 1.0);
#if ARITHMETIC == 0
  precise vec3 sum = vec3(0.0);
#else
  vec3 sum = vec3(0.0);
#endif
  for (uint k = 0u; k < SPRINGS; ++k) {
    place.z += 0.125;  // another spring each time, so that nothing is left out
    sum = sum + springForce(place);
  }
  forces[gl_GlobalInvocationID.x] = vec4(sum, 0.0);
}
