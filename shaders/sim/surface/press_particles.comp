// Moves particles for small colliders: by the mean of the pushes of their triangles, where these want more than all of it.
// STOPS_SLIPS: against the mean of their slips, as far as the friction that is left can.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/surface/common.glsl"
#include "sim/surface/pairs_of_particles.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(binding = RIGHT_HAND_SIDES_UNIT) uniform samplerBuffer rightHandSides;
layout(std430, binding = NEW_POSITIONS_BINDING) buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) buffer NewVelocities { vec4 newVelocities[]; };

void main() {
  uint i = thisEntry();
  if (i >= step.totalParticles || isSettled() || (state.isPressed & 1u) == 0u) return;
  uvec2 range = pairsOf(i);
  vec4 place = newPositions[i];
  precise vec3 sum = vec3(0.0);
  precise float parts = 0.0;
  for (uint k = range.x; k < range.y; ++k) {
    uint entry = pairEntry(k), q = entry / 4u;
    if (!(pairRow(q, 2u).y < 0.0)) continue;
    vec4 wanted = pairRow(q, 3u);
    precise float part = (pairRow(q, 1u)[entry % 4u] * (STOPS_SLIPS != 0 ? 1.0 : place.w)) * wanted.w;
    sum = sum + part * wanted.xyz;
    parts = parts + part;
  }
  if (!(0.0 < parts)) return;
#if STOPS_SLIPS
  float diagonal = texelFetch(rightHandSides, int(i)).w;
  if (!(0.0 < diagonal)) return;
  precise vec3 slip = reciprocal(parts) * sum;
  precise float lost = (parts * reciprocal(diagonal)) * inverseSquareRoot(sumOfProducts(slip, slip));
  precise vec3 moved = -(lost < 1.0 ? lost : 1.0) * slip;
#else
  precise vec3 moved = reciprocal(parts < 1.0 ? 1.0 : parts) * sum;
#endif
  precise vec3 end = place.xyz + moved;
  precise vec3 velocity = newVelocities[i].xyz + step.inverseTimeStep * moved;
  newPositions[i] = vec4(canonical(end), place.w);
  newVelocities[i] = vec4(canonical(velocity), 0.0);
}
