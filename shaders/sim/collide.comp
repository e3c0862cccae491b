// Pass 4: out of spheres, back across planes.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  Particle particle = collideParticle(p.index, Particle(newPositions[p.index], newVelocities[p.index].xyz));
  newPositions[p.index] = particle.position;
  newVelocities[p.index] = vec4(particle.velocity, 0.0);
}
