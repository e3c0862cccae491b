// Whether a free particle has come nearer to a non-adjacent particle than D in this step.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/self/common.glsl"
#include "sim/self/cells.glsl"
#include "sim/self/plan.glsl"

void look(uint i, uint candidate);
#include "sim/self/pairs.glsl"

bool found = false;

void look(uint i, uint candidate) {
  uint j = candidate & INDEX_MASK;
  precise float least = self.clampFactor * pairDistance(candidate);
  precise float leastSquared = least * least;
  precise vec3 d = texelFetch(positionsSoFar, int(i)).xyz - texelFetch(positionsSoFar, int(j)).xyz;
  precise float lengthSquared = sumOfProducts(d, d);
  if (!(lengthSquared < leastSquared)) return;
  precise vec3 before = positionAt(i).xyz - positionAt(j).xyz;
  precise float lengthSquaredBefore = sumOfProducts(before, before);
  found = found || lengthSquared < lengthSquaredBefore;
}

void main() {
  GridPoint p = thisGridPoint();
  if (p.exists && positionAt(p.index).w != 0.0 && contacts.broken == 0u) lookAtCandidates(p);
  if (found) contacts.tooNear = 1u;
  planAfterAll();
}
