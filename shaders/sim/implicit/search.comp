// The next direction p, the product H p, and p.Hp (sim/implicit/total.glsl), for scenes with one cloth. Directions of
// neighbours are worked out where they are needed, from those before: the new ones go into another buffer.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#define MULTIPLIES_PAIRS 1
#define positionAt storedPositionAt
#include "sim/implicit/common.glsl"
#undef positionAt
#include "sim/implicit/updated_direction.glsl"
vec4 positionAt(uint i) { return updatedDirection(i); }
#include "sim/implicit/product.glsl"
#include "sim/implicit/total.glsl"

layout(std430, binding = DIRECTIONS_BINDING) writeonly buffer Directions { vec4 newDirections[]; };
layout(std430, binding = PRODUCTS_BINDING) writeonly buffer Products { vec4 newProducts[]; };

float directionTimesProduct(uint i) {
  vec4 direction = updatedDirection(i);
  vec3 product = productAt(pointOf(i));
  newDirections[i] = direction;
  newProducts[i] = vec4(product, 0.0);
  return sumOfProducts(direction.xyz, product);
}

void main() {
  if (isSkipped()) return;
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationIndex;
  precise float sum = 0.0;
  for (uint k = 0u; k < SUM_BLOCK; k += uint(SUM_LANES))
    if (first + k < step.totalParticles) sum = joined(sum, directionTimesProduct(first + k));
  addToTotal(sum);
}
