// Planes that particles in colliders are pushed back over; the twin is src/solver/cpu/implicit_contact.h.
const bool hasContacts = HAS_CONTACT_PLANES != 0;
layout(binding = CONTACT_PLANES_UNIT) uniform samplerBuffer contactPlanes;

vec4 contactPlaneAt(uint i) { return texelFetch(contactPlanes, int(2u * i)); }

float contactStiffness(float anchorStiffness) {
  precise float stiffness = float(CONTACT_OVER_INERTIA) * anchorStiffness + step.contactStiffness;
  return stiffness;
}

// Along the plane's normal, for a way d; 0 where nothing is touched.
float contactPush(vec4 plane, float anchorStiffness, vec3 d) {
  precise float normalSquared = sumOfProducts(plane.xyz, plane.xyz);
  precise float push = contactStiffness(anchorStiffness) * (plane.w - sumOfProducts(plane.xyz, d));
  return normalSquared > 0.0 ? push : 0.0;
}
