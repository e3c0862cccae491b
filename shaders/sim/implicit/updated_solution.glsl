// The residuals and increments after a step of conjugate gradients along the direction.
#include "sim/implicit/vectors.glsl"

vec3 updatedResidual(uint i) {
  precise vec3 residual = texelFetch(residuals, int(i)).xyz - scalars.stepSize * texelFetch(products, int(i)).xyz;
  return canonical(residual);
}
vec3 updatedIncrement(uint i) {
  precise vec3 increment = texelFetch(increments, int(i)).xyz + scalars.stepSize * texelFetch(directions, int(i)).xyz;
  return canonical(increment);
}
