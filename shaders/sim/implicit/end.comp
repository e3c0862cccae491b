// Positions and velocities at the end of an implicit step, before contacts.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/implicit/time_scheme.glsl"

// What the solution leaves of Coulomb's friction stops the slip, or shortens it: nothing creeps that sticks.
vec3 withFriction(uint i, vec3 displacement) {
  vec3 slip = slipOf(contactPlaneAt(i).xyz, carryAt(i).xyz, displacement);
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float used = frictionSlope(len, inverse, slowSlip()).over * len;
  precise float rest = frictionLimitAt(i) * (1.0 - used);
  precise float lost = (larger(rest, 0.0) * reciprocal(texelFetch(rightHandSides, int(i)).w)) * inverse;
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
    if (hasContacts) displacement = withFriction(i, displacement);
    precise vec3 place = x.xyz + displacement;
    TimeScheme scheme = timeScheme();
    precise vec3 relative = displacement;
    if (scheme.isSecondOrder) relative = displacement - movedBefore(i);
    precise vec3 v = scheme.rate * relative;
    particle = Particle(vec4(canonical(place), x.w), canonical(v));
    watchVelocity(PASS_INTEGRATE, i, particle.velocity);
  }
  newPositions[i] = particle.position;
  newVelocities[i] = vec4(particle.velocity, 0.0);
  reportDivergence();
}
