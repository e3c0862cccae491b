// How the energy of seams would change: a spring belongs to its end of the larger index.
#include "sim/implicit/energy.glsl"
#include "sim/implicit/seams.glsl"

vec4 addSeamTrials(uint i, vec4 trial) {
  uvec2 range = seamsOf(i);
  precise vec4 sum = trial;
  for (uint n = range.x; n < range.y; ++n) {
    SeamSpring spring = seamSpring(n);
    if (spring.other > i) continue;
    precise vec3 d = iterateAt(spring.other).xyz - iterateAt(i).xyz;
    precise vec3 e = incrementAt(spring.other) - incrementAt(i);
    for (int k = 0; k < LENGTHS_TRIED; ++k) sum[k] = sum[k] + springChange(d, e, lengthsTried[k], seamAsSpring(spring));
  }
  return sum;
}
