// Integrate: velocities and positions at the end of the step.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  Particle particle = integrateParticle(p, forces[p.index].xyz);
  newPositions[p.index] = particle.position;
  newVelocities[p.index] = vec4(particle.velocity, 0.0);
  reportDivergence();
}
