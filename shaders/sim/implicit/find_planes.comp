// What colliders the iterate is in: the planes in which particles touch them. Where several are touched, the last of the
// scene's counts; what touches nothing keeps its plane. With PREDICTS, from where the velocities take them, particles that
// touch nothing there get the planes where inertia and gravity alone would take them, or else that of the first collider that
// is as near as a solved step may be wrong; and it is said whether what touches is not what touched before.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"
#include "sim/implicit/contact.glsl"

layout(std430, binding = CONTACT_PLANES_BINDING) writeonly buffer Planes { vec4 newPlanes[]; };
#if PREDICTS
layout(std430, binding = CONTACT_BLOCKS_BINDING) writeonly buffer ContactBlocks { vec4 newContactBlocks[]; };
#endif
layout(binding = ELASTIC_SLIPS_UNIT) uniform samplerBuffer elasticSlips;
vec4 plane = vec4(0.0), carry = vec4(0.0);
bool touches = false;
bool hasPlane() { return sumOfProducts(plane.xyz, plane.xyz) > 0.0; }

void findPlanesAt(vec4 start, vec3 place, float margin) {
  vec3 elasticSlip = texelFetch(elasticSlips, int(thisGridPoint().index)).xyz;
  for (uint k = 0u; k < step.colliderCount && start.w != 0.0; ++k) {
    ColliderParams collider = loadCollider(step.firstCollider + k);
    vec3 previous = carried(collider, start.xyz);
    Contact contact = findContact(collider, previous, place);
    if (!contact.touches) {
      if (margin == 0.0 || hasPlane()) continue;
      contact = nearContact(collider, contact, place);
      if (!(abs(contact.depth) < margin)) continue;
    }
    bool isFromBelow = contact.touches && contact.depth < 0.0;  // a plane may be met from there
    vec3 normal = isFromBelow ? -contact.normal : contact.normal;
    precise vec3 reach = (place - start.xyz) + contact.outward;
    precise float offset = sumOfProducts(normal, reach);
    precise vec3 carriedBy = (previous - start.xyz) - elasticSlip;
    plane = vec4(normal, offset);
    touches = touches || contact.touches;
    carry = vec4(carriedBy, hasCoulombFriction ? collider.friction : 0.0);
  }
}

void main() {
  if (isSkipped()) return;
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 start = texelFetch(starts, int(p.index));
#if PREDICTS
  vec3 v = velocityAt(p.index);
  precise vec3 guess = start.xyz + step.guessTime * (v + step.timeStep * vec3(step.gravityX, step.gravityY, step.gravityZ));
  precise vec3 way = step.timeStep * v;
  precise vec3 place = start.xyz + canonical(way);
  precise float margin = step.tolerance * step.leastMotion;
  for (int turn = 0; turn < 2; ++turn) findPlanesAt(start, turn == 0 ? guess : canonical(place), turn == 0 ? 0.0 : margin);
  float held = texelFetch(elasticSlips, int(p.index)).w;
#if HAS_HISTORY
  if (held > 0.0 ? !hasPlane() : touches) atomicOr(scalars.hasNewContacts, 1u);
#endif
  newContactBlocks[2u * p.index] = vec4(held, 0.0, 0.0, 0.0);  // for the first Newton step
#else
  findPlanesAt(start, iterateAt(p.index).xyz, 0.0);
  if (!touches) return;
#endif
  newPlanes[2u * p.index] = plane;
  newPlanes[2u * p.index + 1u] = carry;
}
