// How the pairs press at the displacements so far: forces, and what they add to the Hessian.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/surface/pairs.glsl"

layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };

uint thisPair() { return (gl_WorkGroupID.y * GROUPS_A_ROW + gl_WorkGroupID.x) * uint(SURFACE_GROUP) + gl_LocalInvocationIndex; }
vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

void main() {
  uint q = thisPair();
  if (isSkipped() || q >= scalars.pairs) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  vec4 normal = pairRow(q, 0u), law = pairRow(q, 2u);
  vec3 moved = weightedSum(pairRow(q, 1u), displacementAt(ids.x), displacementAt(ids.y), displacementAt(ids.z), displacementAt(ids.w));
  float along = sumOfProducts(normal.xyz, moved);
  precise float over = normal.w - along;
  vec3 relative = relativeToPair(q, moved);
  precise vec3 slip = relative - sumOfProducts(normal.xyz, relative) * normal.xyz;
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float across = law.z * frictionSlope(len, inverse, slowSlip()).over;
  float held = law.y > 0.0 ? law.w : over > 0.0 ? law.x : 0.0;
  precise vec3 force = (held * over) * normal.xyz - across * slip;
  newRows[4u * q + 2u] = vec4(law.xyz, held);
  newRows[4u * q + 3u] = vec4(canonical(force), canonical(across));
}
