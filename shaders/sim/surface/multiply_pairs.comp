// What the pairs do to the directions.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/surface/pairs.glsl"

layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };

uint thisPair() { return (gl_WorkGroupID.y * GROUPS_A_ROW + gl_WorkGroupID.x) * uint(SURFACE_GROUP) + gl_LocalInvocationIndex; }
vec3 directionAt(uint i) { return texelFetch(directions, int(i)).xyz; }

void main() {
  uint q = thisPair();
  if (isSkipped() || q >= scalars.pairs) return;
  uvec4 ids = texelFetch(pairIds, int(q));
  vec3 normal = pairRow(q, 0u).xyz;
  float held = pairRow(q, 2u).w, across = pairRow(q, 3u).w;
  vec3 moved = weightedSum(pairRow(q, 1u), directionAt(ids.x), directionAt(ids.y), directionAt(ids.z), directionAt(ids.w));
  precise float beyond = (held - across) * sumOfProducts(normal, moved);
  precise vec3 force = across * moved + beyond * normal;
  newRows[4u * q + 3u] = vec4(canonical(force), across);
}
