// increments += stepSize * directions, residuals -= stepSize * products
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/updated_solution.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };
layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (!isParticle(i)) return;
  newIncrements[i] = vec4(updatedIncrement(i), 0.0);
  newResiduals[i] = vec4(updatedResidual(i), 0.0);
}
