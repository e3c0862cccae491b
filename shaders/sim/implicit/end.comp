// Positions and velocities at the end of an implicit step, before contacts.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/implicit/time_scheme.glsl"

layout(binding = ELASTIC_SLIPS_UNIT) uniform samplerBuffer elasticSlips;
layout(std430, binding = NEW_ELASTIC_SLIPS_BINDING) writeonly buffer ElasticSlips { vec4 newElasticSlips[]; };

// How the slip of a step ends: `elastic` of it, and of what was before, friction remembers and begins with in the next step;
// `taken` is taken back. So what sticks stays where it is.
struct SlipEnd {
  vec3 elastic, taken;
};
SlipEnd slipEnd(uint i) {
  float limit = frictionLimitAt(i), slow = slowSlip();
  vec3 normal = contactPlaneAt(i).xyz, before = texelFetch(elasticSlips, int(i)).xyz;
  vec3 slip = slipOf(normal, carryAt(i).xyz, texelFetch(displacements, int(i)).xyz);
  precise vec3 own = slip - (before - sumOfProducts(normal, before) * normal);
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float used = frictionSlope(len, inverse, slow).over * len;
  precise float part = slow * inverse;
  // What the solution leaves of Coulomb's friction stops the slip, or shortens it.
  precise float left = limit * (1.0 - used);
  precise float rest = larger(left, 0.0) * reciprocal(texelFetch(rightHandSides, int(i)).w);
  precise float lost = rest * inverseSquareRoot(sumOfProducts(own, own));
  precise vec3 elastic = (part < 1.0 ? part : 1.0) * slip;
  precise vec3 taken = (lost < 1.0 ? lost : 1.0) * own;
  if (limit > 0.0) return SlipEnd(elastic, taken);
  return SlipEnd(vec3(0.0), vec3(0.0));
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  Particle particle = Particle(x, vec3(0.0));
  SlipEnd slip = SlipEnd(vec3(0.0), vec3(0.0));
  if (hasContacts) {
    slip = slipEnd(i);
    vec3 block = contactBlockAt(i).diagonal;
    precise float trace = (block.x + block.y) + block.z;
    newElasticSlips[i] = vec4(canonical(slip.elastic), heldLimit(trace > 0.0, frictionLimitAt(i)));
  }
  if (x.w == 0.0) {
    if (hasMovingPins) particle = movePin(i, x);
  } else {
    precise vec3 moved = texelFetch(displacements, int(i)).xyz - slip.taken;
    vec3 displacement = canonical(moved);
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
