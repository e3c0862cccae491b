// What colliders the iterate is in: the planes in which particles touch them. Where several are touched, the last of the
// scene's counts.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"

layout(std430, binding = CONTACT_PLANES_BINDING) writeonly buffer Planes { vec4 newPlanes[]; };

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 start = texelFetch(starts, int(p.index));
  vec3 place = iterateAt(p.index).xyz;
  vec4 plane = vec4(0.0), carry = vec4(0.0);
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
    carry = vec4(carriedBy, hasCoulombFriction ? collider.friction : 0.0);
  }
  newPlanes[2u * p.index] = plane;
  newPlanes[2u * p.index + 1u] = carry;
}
