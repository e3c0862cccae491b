// Planes that particles in colliders are pushed back over; the twin is src/solver/cpu/implicit_contact.h.
const bool hasContacts = HAS_CONTACT_PLANES != 0;
layout(binding = CONTACT_PLANES_UNIT) uniform samplerBuffer contactPlanes;

vec4 carryAt(uint i) { return texelFetch(contactPlanes, int(PLANE_TEXELS * i + 1u)); }
float gripAt(uint i) { return texelFetch(contactPlanes, int(PLANE_TEXELS * i + 3u)).x; }
vec4 lastPlaneAt(uint i) { return texelFetch(contactPlanes, int(PLANE_TEXELS * i + 2u)); }
vec4 contactPlaneAt(uint i) { return texelFetch(contactPlanes, int(PLANE_TEXELS * i)); }

float contactStiffness(float diagonal) {
  precise float stiffness = float(CONTACT_OVER_INERTIA) * diagonal + step.contactStiffness;
  return stiffness;
}

// Along the plane's normal, for a displacement d; 0 where nothing is touched.
float contactPush(vec4 plane, float diagonal, vec3 d) {
  precise float normalSquared = sumOfProducts(plane.xyz, plane.xyz);
  precise float push = contactStiffness(diagonal) * (plane.w - sumOfProducts(plane.xyz, d));
  return normalSquared > 0.0 ? push : 0.0;
}

// How far a displacement d goes along the plane, relative to the collider.
vec3 slipOf(vec3 normal, vec3 carry, vec3 d) {
  precise vec3 relative = d - carry;
  precise vec3 slip = relative - sumOfProducts(normal, relative) * normal;
  return slip;
}
// What touching adds to a product of the Hessian: across the plane, and along it.
vec3 contactProduct(uint i, float diagonal, vec3 p) {
  vec3 normal = contactPlaneAt(i).xyz;
  float grip = gripAt(i);
  precise vec3 product = grip * p + ((contactStiffness(diagonal) - grip) * sumOfProducts(normal, p)) * normal;
  return product;
}

// How steeply friction rises with the slip: in full beyond `slow` (Li et al. 2020, "Incremental potential contact", equation 14).
float frictionOver(float slip, float inverseSlip, float slow) {
  float inverseSlow = reciprocal(slow);
  precise float rising = inverseSlow * (2.0 - slip * inverseSlow);
  return slip < slow ? rising : inverseSlip;
}

// How the energy changes when what crosses the last plane, `over` deep, moves on to `overAfter`.
float contactChange(float stiffness, float over, float overAfter) {
  float before = over < 0.0 ? 0.0 : over, after = overAfter < 0.0 ? 0.0 : overAfter;
  precise float change = 0.5 * ((stiffness * (after - before)) * (after + before));
  return change;
}
