// Collide: particles that are inside a collider, or went through it, come back to its surface.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  int i = int(p.index);
  vec4 velocity = texelFetch(velocitiesSoFar, i);
  Particle particle = Particle(texelFetch(positionsSoFar, i), velocity.xyz);
  particle = collideParticle(p.index, particle);
  newPositions[p.index] = particle.position;
  newVelocities[p.index] = vec4(particle.velocity, velocity.w);
  reportDivergence();
}
