// Positions and velocities at the end of an implicit step, before contacts.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/implicit/contact.glsl"

// How much of its weight something held up, 0 to 1 (src/solver/implicit.h).
float supportOf(vec3 before, vec3 displacement) {
  precise float scale = step.inertia * step.timeStep;
  precise vec3 fallen = scale * displacement - before;
  precise float support = 1.0 - sumOfProducts(fallen, vec3(step.gravityX, step.gravityY, step.gravityZ)) * step.supportScale;
  float atLeast = 0.0 < support ? support : 0.0;
  return atLeast < 1.0 ? atLeast : 1.0;
}

// Friction takes back, along the surface, up to its coefficient times how far the collider pushed the particle out.
vec3 withFriction(vec3 normal, vec4 carry, float depth, vec3 displacement) {
  precise vec3 relative = displacement - carry.xyz;
  precise vec3 across = sumOfProducts(relative, normal) * normal;
  precise vec3 slide = relative - across;
  precise float lost = (carry.w * depth) * inverseSquareRoot(sumOfProducts(slide, slide));
  precise float rest = 1.0 - lost;
  float kept = lost < 1.0 ? rest : 0.0;
  precise vec3 result = (carry.xyz + across) + kept * slide;
  return canonical(result);
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
    vec3 displacement = texelFetch(displacements, int(i)).xyz;
    vec4 place = iterateAt(i);
    precise vec3 unpushed = displacement;  // without what a collider did
    if (hasContacts) {
      vec4 plane = contactPlaneAt(i);
      float push = contactPush(plane, texelFetch(rightHandSides, int(i)).w, displacement);
      precise float inertia = reciprocal(x.w) * step.inertia;
      precise float pushedBy = push * reciprocal(inertia);
      float depth = push > 0.0 ? pushedBy : 0.0;
      unpushed = displacement - depth * plane.xyz;
      if (depth > 0.0) {
        displacement = withFriction(plane.xyz, texelFetch(contactPlanes, int(2u * i + 1u)), depth, displacement);
        precise vec3 slid = x.xyz + displacement;
        place = vec4(canonical(slid), x.w);
      }
    }
    precise vec3 v = step.inverseTimeStep * displacement;
    support = supportOf(velocityAt(i), unpushed);
    particle = Particle(place, canonical(v));
    watchVelocity(PASS_INTEGRATE, i, particle.velocity);
  }
  newPositions[i] = particle.position;
  newVelocities[i] = vec4(particle.velocity, support);
  reportDivergence();
}
