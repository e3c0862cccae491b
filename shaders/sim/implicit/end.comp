// Positions and velocities at the end of an implicit step, before contacts.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/implicit/contact.glsl"

// What the solution leaves of Coulomb's friction stops the slip, or shortens it: nothing creeps that sticks.
vec3 withFriction(uint i, float inverseMass, float push, vec3 displacement) {
  vec4 carry = carryAt(i);
  vec3 slip = slipOf(contactPlaneAt(i).xyz, carry.xyz, displacement);
  float squared = sumOfProducts(slip, slip);
  float inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float rest = carry.w * push - gripAt(i) * len;
  precise float inertia = reciprocal(inverseMass) * step.inertia;
  precise float lost = larger(rest, 0.0) * reciprocal(inertia) * inverse;
  float taken = lost < 1.0 ? lost : 1.0;
  precise vec3 result = displacement - taken * slip;
  return canonical(result);
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  Particle particle = Particle(x, vec3(0.0));
  if (x.w == 0.0) {
    if (hasMovingPins) particle = movePin(i, x);
  } else {
    vec3 displacement = texelFetch(displacements, int(i)).xyz;
    vec4 place = iterateAt(i);
    if (hasContacts) {
      vec4 plane = contactPlaneAt(i);
      float push = contactPush(plane, texelFetch(rightHandSides, int(i)).w, displacement);
      if (push > 0.0) {
        displacement = withFriction(i, x.w, push, displacement);
        precise vec3 slid = x.xyz + displacement;
        place = vec4(canonical(slid), x.w);
      }
    }
    precise vec3 v = step.inverseTimeStep * displacement;
    particle = Particle(place, canonical(v));
    watchVelocity(PASS_INTEGRATE, i, particle.velocity);
  }
  newPositions[i] = particle.position;
  newVelocities[i] = vec4(particle.velocity, 0.0);
  reportDivergence();
}
