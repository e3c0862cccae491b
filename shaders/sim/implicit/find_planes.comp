// What colliders the iterate is in: the planes in which particles touch them. Where several are touched, the last of the
// scene's counts; what touches nothing keeps its plane. With PREDICTS, particles that touch nothing there get the planes where
// inertia and gravity alone would take them, and all start on their planes.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"

layout(std430, binding = CONTACT_PLANES_BINDING) writeonly buffer Planes { vec4 newPlanes[]; };
#if PREDICTS
layout(std430, binding = DISPLACEMENTS_BINDING) writeonly buffer Displacements { vec4 newDisplacements[]; };
layout(std430, binding = ITERATES_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };
#endif

vec4 plane = vec4(0.0), carry = vec4(0.0);
bool touches = false;

void findPlanesAt(vec4 start, vec3 place) {
  for (uint k = 0u; k < step.colliderCount && start.w != 0.0; ++k) {
    ColliderParams collider = loadCollider(step.firstCollider + k);
    vec3 previous = carried(collider, start.xyz);
    Contact contact = findContact(collider, previous, place);
    if (!contact.touches) continue;
    vec3 normal = contact.depth < 0.0 ? -contact.normal : contact.normal;  // a plane may be met from below
    precise vec3 reach = (place - start.xyz) + contact.outward;
    precise float offset = sumOfProducts(normal, reach);
    precise vec3 carriedBy = previous - start.xyz;
    plane = vec4(normal, offset);
    touches = true;
    carry = vec4(carriedBy, hasCoulombFriction ? collider.friction : 0.0);
  }
}

#if PREDICTS
void startOnPlane(uint i, vec4 start) {
  vec3 d = texelFetch(displacements, int(i)).xyz;
  precise vec3 raised = d + (plane.w - sumOfProducts(plane.xyz, d)) * plane.xyz;
  vec3 displacement = canonical(raised);
  precise vec3 place = start.xyz + displacement;
  newDisplacements[i] = vec4(displacement, 0.0);
  newIterates[i] = vec4(canonical(place), start.w);
}
#endif

void main() {
  if (isSkipped()) return;
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 start = texelFetch(starts, int(p.index));
#if PREDICTS
  precise vec3 guess = start.xyz + step.guessTime * (velocityAt(p.index) + step.timeStep * vec3(step.gravityX, step.gravityY, step.gravityZ));
  findPlanesAt(start, guess);
#endif
  findPlanesAt(start, iterateAt(p.index).xyz);
#if PREDICTS
  if (touches) startOnPlane(p.index, start);
#else
  if (!touches) return;
#endif
  newPlanes[2u * p.index] = plane;
  newPlanes[2u * p.index + 1u] = carry;
}
