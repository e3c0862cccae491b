// Forces, integrate and, without self-collision, collide in one dispatch: nothing between them needs a neighbour's new
// state.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec3 force = gatherForces(p);
  Particle particle = integrateParticle(p, force);
  if (COLLIDES_IN_STEP != 0) particle = collideParticle(p.index, particle);
  newPositions[p.index] = particle.position;
  newVelocities[p.index] = vec4(particle.velocity, 0.0);
  reportDivergence();
}
