// products = H directions. POSITIONS_UNIT: the directions.
#define MULTIPLIES_PAIRS 0
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/implicit/product.glsl"

layout(std430, binding = PRODUCTS_BINDING) writeonly buffer Products { vec4 newProducts[]; };

void main() {
  if (isSkipped()) return;
  GridPoint point = thisGridPoint();
  if (point.exists) newProducts[point.index] = vec4(productAt(point), 0.0);
}
