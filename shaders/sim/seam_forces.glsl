// The forces of seams.
#include "sim/seams.glsl"

vec3 addSeamForces(uint i, vec3 force) {
  uvec2 range = seamsOf(i);
  precise vec3 f = force;
  for (uint n = range.x; n < range.y; ++n) {
    SeamSpring spring = seamSpring(n);
    f = f + springForce(positionAt(i).xyz, positionAt(spring.other).xyz, spring.stiffness, spring.restLength);
  }
  return f;
}
