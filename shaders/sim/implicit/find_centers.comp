// Where the aggregates of a level are: the weighted mean of the places of what hangs on them.
#include "sim/implicit/level.glsl"
#include "sim/implicit/restriction_lists.glsl"

layout(std430, binding = CENTERS_BINDING) writeonly buffer Centers { vec4 newCenters[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.coarseCount)) return;
  uint coarse = level.coarseFirst + i;
  precise vec3 sum = vec3(0.0);
  precise float weights = 0.0;
  uvec2 range = rangeAt(restrictionStarts, coarse);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(restriction, n);
    sum = sum + weight.weight * placeOf(weight.vertex);
    weights = weights + weight.weight;
  }
  precise vec3 center = reciprocal(weights) * sum;
  newCenters[coarse] = vec4(canonical(center), 0.0);
}
