// Positions and velocities at the end of an implicit step, before contacts.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  Particle particle = Particle(x, vec3(0.0));
  if (x.w == 0.0) {
    if (hasMovingPins) particle = movePin(i, x);
  } else {
    precise vec3 v = step.inverseTimeStep * texelFetch(ways, int(i)).xyz;
    particle = Particle(iterateAt(i), canonical(v));
    watchVelocity(PASS_INTEGRATE, i, particle.velocity);
  }
  newPositions[i] = particle.position;
  newVelocities[i] = vec4(particle.velocity, 0.0);
  reportTrouble();
}
