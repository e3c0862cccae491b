// Turns v(n-1/2) into v(n) or back when the integrator changes: v' = v + kickTime a.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/forces.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  float inverseMass = positionAt(p.index).w;
  vec3 acceleration = accelerationOf(gatherForces(p), inverseMass);
  precise vec3 v = velocityAt(p.index) + step.kickTime * acceleration;
  newVelocities[p.index] = vec4(inverseMass == 0.0 ? vec3(0.0) : canonical(v), 0.0);
}
