// Whether the hash of an earlier step still serves: no particle has moved farther since than the margin allows.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/self/common.glsl"
#include "sim/self/plan.glsl"

float movedSquared(vec3 now, vec3 then) {
  precise vec3 d = now - then;
  precise float result = sumOfProducts(d, d);
  return result;
}

void look(GridPoint p) {
  vec3 x = texelFetch(positionsSoFar, int(p.index)).xyz;
  precise float sinceHashed = movedSquared(x, texelFetch(hashedPositions, int(p.index)).xyz);
  if (!(sinceHashed < self.reuseSquared)) contacts.stale = 1u;
  if (SELF_ROBUST == 0) return;
  precise float inStep = movedSquared(x, positionAt(p.index).xyz);
  if (!(inStep < self.fastSquared)) contacts.fast = 1u;
}

void main() {
  GridPoint p = thisGridPoint();
  if (p.exists) look(p);
  planAfterAll();
}
