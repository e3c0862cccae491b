// What the step has changed, and whether something else than the solution had a part in it, as contact between particles: such
// a history does not count.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"

layout(std430, binding = HISTORIES_BINDING) writeonly buffer Histories { vec4 newHistories[]; };

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  float third = uintBitsToFloat(0x3eaaaaabu);
  precise float most = step.tolerance * step.leastMotion;
  precise vec3 moved = texelFetch(positionsSoFar, int(i)).xyz - texelFetch(starts, int(i)).xyz;
  precise vec3 accelerated = texelFetch(velocitiesSoFar, int(i)).xyz - velocityAt(i);
  precise vec3 aside = moved - texelFetch(displacements, int(i)).xyz;
  precise vec3 movedPart = third * moved;
  precise vec3 acceleratedPart = third * accelerated;
  precise float square = most * most;
  newHistories[2u * i] = vec4(canonical(movedPart), 0.0);
  newHistories[2u * i + 1u] = vec4(canonical(acceleratedPart), 0.0);
  if (sumOfProducts(aside, aside) > square) atomicOr(scalars.isDisturbed, 1u);
}
