// Positions and velocities at the end of an implicit step, before contacts.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"

// How much of its weight something held up, 0 to 1 (src/solver/implicit.h).
float supportOf(vec3 before, vec3 way) {
  precise float scale = step.inertia * step.timeStep;
  precise vec3 fallen = scale * way - before;
  precise float support = 1.0 - sumOfProducts(fallen, vec3(step.gravityX, step.gravityY, step.gravityZ)) * step.supportScale;
  float atLeast = 0.0 < support ? support : 0.0;
  return atLeast < 1.0 ? atLeast : 1.0;
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  Particle particle = Particle(x, vec3(0.0));
  float support = 0.0;
  if (x.w == 0.0) {
    if (hasMovingPins) particle = movePin(i, x);
  } else {
    vec3 way = texelFetch(ways, int(i)).xyz;
    precise vec3 v = step.inverseTimeStep * way;
    support = supportOf(velocityAt(i), way);
    particle = Particle(iterateAt(i), canonical(v));
    watchVelocity(PASS_INTEGRATE, i, particle.velocity);
  }
  newPositions[i] = particle.position;
  newVelocities[i] = vec4(particle.velocity, support);
  reportTrouble();
}
