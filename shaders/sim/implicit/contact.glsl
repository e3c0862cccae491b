// Planes that particles in colliders are pushed back over; the twin is src/solver/cpu/implicit_contact.h.
const bool hasContacts = HAS_CONTACT_PLANES != 0;
layout(binding = CONTACT_PLANES_UNIT) uniform samplerBuffer contactPlanes;
layout(binding = CONTACT_BLOCKS_UNIT) uniform samplerBuffer contactBlocks;

vec4 contactPlaneAt(uint i) { return texelFetch(contactPlanes, int(2u * i)); }
vec4 carryAt(uint i) { return texelFetch(contactPlanes, int(2u * i + 1u)); }

Symmetric contactBlockAt(uint i) {
  return Symmetric(texelFetch(contactBlocks, int(2u * i)).xyz, texelFetch(contactBlocks, int(2u * i + 1u)).xyz);
}
// What the last Newton step has set.
float frictionLimitAt(uint i) { return texelFetch(contactBlocks, int(2u * i)).w; }

// How stiffly a collider pushes back (CONTACT_OVER_INERTIA).
float contactStiffness(float diagonal) {
  precise float stiffness = float(CONTACT_OVER_INERTIA) * diagonal + step.contactStiffness;
  return stiffness;
}

// What is remembered of a contact (LEAST_HELD), and the limit of friction that this says.
float heldLimit(bool holds, float limit) { return holds ? larger(limit, LEAST_HELD) : 0.0; }
float limitOf(float held) { return held > LEAST_HELD ? held : 0.0; }

// How far a displacement d goes along the plane, relative to the collider.
vec3 slipOf(vec3 normal, vec3 carry, vec3 d) {
  precise vec3 relative = d - carry;
  precise vec3 slip = relative - sumOfProducts(normal, relative) * normal;
  return slip;
}

// The nearest displacement that ends on the plane; d itself where there is none.
vec3 onPlane(vec4 plane, vec3 d) {
  precise vec3 moved = d + (plane.w - sumOfProducts(plane.xyz, d)) * plane.xyz;
  return sumOfProducts(plane.xyz, plane.xyz) > 0.0 ? moved : d;
}

// Friction of a limit of 1 against a slip: its force over the slip, and how steeply the force rises along it. It is in full
// beyond `slow` (Li et al. 2020, "Incremental potential contact", equation 14).
struct FrictionSlope {
  float over, along;
};
FrictionSlope frictionSlope(float slip, float inverseSlip, float slow) {
  float inverseSlow = reciprocal(slow);
  precise float part = slip * inverseSlow;
  precise float over = inverseSlow * (2.0 - part);
  precise float along = inverseSlow * (2.0 - 2.0 * part);
  bool isSlow = slip < slow;
  return FrictionSlope(isSlow ? over : inverseSlip, isSlow ? along : 0.0);
}
// The potential of that force.
float frictionPotential(vec3 slip, float slow) {
  float squared = sumOfProducts(slip, slip);
  precise float len = squared * inverseSquareRoot(squared);
  precise float part = len * reciprocal(slow);
  float third = uintBitsToFloat(0x3eaaaaabu);
  precise float rising = slow * ((part * part) * (1.0 - third * part));
  precise float full = len - third * slow;
  return len < slow ? rising : full;
}
float slowSlip() {
  precise float slow = uintBitsToFloat(0x3c23d70au) * step.timeStep;  // SLOW_SLIP
  return slow;
}

// How the energy changes when what crosses a plane, `over` deep, moves on to `overAfter`.
float contactChange(float stiffness, float over, float overAfter) {
  float before = over < 0.0 ? 0.0 : over, after = overAfter < 0.0 ? 0.0 : overAfter;
  precise float change = 0.5 * ((stiffness * (after - before)) * (after + before));
  return change;
}
