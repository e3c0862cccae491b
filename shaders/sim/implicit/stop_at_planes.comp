// Increments of particles that no plane holds end where they would cross theirs: src/solver/cpu/implicit_contact.h.
#include "sim/implicit/common.glsl"
#include "sim/implicit/contact.glsl"

layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

void main() {
  if (isSkipped()) return;
  uint i = thisParticle();
  if (!isParticle(i) || iterateAt(i).w == 0.0) return;
  vec3 held = contactBlockAt(i).diagonal;
  if ((held.x + held.y) + held.z > 0.0) return;
  vec4 plane = contactPlaneAt(i);
  vec3 e = texelFetch(increments, int(i)).xyz;
  precise float over = plane.w - sumOfProducts(plane.xyz, texelFetch(displacements, int(i)).xyz);
  precise float after = over - sumOfProducts(plane.xyz, e);
  precise vec3 stopped = e + after * plane.xyz;
  if (after > 0.0) newIncrements[i] = vec4(canonical(stopped), 0.0);
}
