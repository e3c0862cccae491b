// Turns v(n-1/2) into v(n) or back when the integrator changes: v' = v + kickTime a. Pins keep
// the velocity of their path.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  float inverseMass = positionAt(p.index).w;
  vec3 acceleration = accelerationOf(gatherForces(p), inverseMass);
  vec3 velocity = velocityAt(p.index);
  precise vec3 v = velocity + step.kickTime * acceleration;
  precise vec3 newV = inverseMass == 0.0 ? velocity : canonical(v);
  newVelocities[p.index] = vec4(newV, 0.0);
  watchVelocity(PASS_KICK, p.index, newV);
  reportDivergence();
}
