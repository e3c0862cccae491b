// The direction after the last one, corrections + kept * directions, and the inverse mass.
#include "sim/implicit/vectors.glsl"

vec4 updatedDirection(uint i) {
  // The first direction is the correction alone: what lies in the buffer belongs to another Newton step.
  vec3 last = scalars.kept == 0.0 ? vec3(0.0) : texelFetch(directions, int(i)).xyz;
  precise vec3 p = texelFetch(corrections, int(i)).xyz + scalars.kept * last;
  return vec4(canonical(p), iterateAt(i).w);
}
