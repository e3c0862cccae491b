// increments += stepSize * directions, residuals -= stepSize * products
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };
layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (!isParticle(i)) return;
  precise vec3 increment = texelFetch(increments, int(i)).xyz + scalars.stepSize * texelFetch(directions, int(i)).xyz;
  precise vec3 residual = texelFetch(residuals, int(i)).xyz - scalars.stepSize * texelFetch(products, int(i)).xyz;
  newIncrements[i] = vec4(canonical(increment), 0.0);
  newResiduals[i] = vec4(canonical(residual), 0.0);
}
