// What the pairs do to the directions.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/vectors.glsl"
#include "sim/surface/pairs.glsl"

layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };

vec3 directionAt(uint i) { return texelFetch(directions, int(i)).xyz; }
#include "sim/surface/pair_product.glsl"

void main() {
  uint q = thisPair();
  if (isSkipped() || q >= scalars.pairs) return;
  newRows[4u * q + 3u] = vec4(pairProduct(q), pairRow(q, 3u).w);
}
