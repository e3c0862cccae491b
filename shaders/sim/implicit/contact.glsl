// Planes that particles in colliders are pushed back over; the twin is src/solver/cpu/implicit_contact.h.
const bool hasContacts = HAS_CONTACT_PLANES != 0;
layout(binding = CONTACT_PLANES_UNIT) uniform samplerBuffer contactPlanes;

vec4 contactPlaneAt(uint i) { return texelFetch(contactPlanes, int(2u * i)); }

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
