// What colliders the iterate is in: the planes in which particles touch them. Where several are touched, the last of the
// scene's counts. With PREDICTS, particles that touch nothing there get the planes where inertia and gravity alone would take
// them.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/collide.glsl"
#include "sim/implicit/contact.glsl"

layout(std430, binding = CONTACT_PLANES_BINDING) writeonly buffer Planes { vec4 newPlanes[]; };

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

// Coulomb's law, with the push that the last solution has come to: a spring against the slip so far.
float gripOf(uint i) {
  vec3 d = texelFetch(displacements, int(i)).xyz;
  vec3 slip = slipOf(plane.xyz, carry.xyz, d);
  float push = contactPush(plane, texelFetch(rightHandSides, int(i)).w, d);
  precise float slow = uintBitsToFloat(0x3c23d70au) * step.timeStep;  // SLOW_SLIP
  float squared = sumOfProducts(slip, slip);
  float inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  precise float grip = (carry.w * push) * frictionOver(len, inverse, slow);
  return push > 0.0 ? grip : 0.0;
}

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
  newPlanes[PLANE_TEXELS * p.index] = plane;
  newPlanes[PLANE_TEXELS * p.index + 1u] = carry;
  newPlanes[PLANE_TEXELS * p.index + 3u] = vec4(PREDICTS != 0 || start.w == 0.0 ? 0.0 : gripOf(p.index), 0.0, 0.0, 0.0);
  if (touches || PREDICTS != 0) newPlanes[PLANE_TEXELS * p.index + 2u] = plane;
}
