// directions = corrections + kept * directions
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/updated_direction.glsl"

layout(std430, binding = DIRECTIONS_BINDING) writeonly buffer Directions { vec4 newDirections[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (isParticle(i)) newDirections[i] = updatedDirection(i);
}
