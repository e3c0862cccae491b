// Where motion was cut short, or parts were pushed far apart, the step goes on from there.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(binding = STARTS_UNIT) uniform samplerBuffer starts;  // of the step
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Safe { vec4 safePositions[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) writeonly buffer Displacements { vec4 newDisplacements[]; };
layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };
layout(std430, binding = SURFACE_VELOCITIES_BINDING) readonly buffer NewVelocities { vec4 newVelocities[]; };
layout(std430, binding = SURFACE_COUNTS_BINDING) writeonly buffer SafeVelocities { vec4 safeVelocities[]; };

void main() {
  uint i = thisEntry();
  bool goesOn = state.isGuarded != 0u || state.wasPushedFar != 0u;
  if (i == 0u) {
    state.isLater = 1u;
    state.isSettled = goesOn ? 0u : 1u;
    scalars.isStepSolved = goesOn ? 0u : scalars.isStepSolved == 1u ? 1u : STEP_ENDED;
  }
  if (i >= step.totalParticles) return;
  vec4 start = texelFetch(starts, int(i));
  vec3 place = texelFetch(positionsSoFar, int(i)).xyz;
  safePositions[i] = vec4(place, start.w);
  safeVelocities[i] = newVelocities[i];
  if (!goesOn) return;
  precise vec3 displacement = place - start.xyz;
  newDisplacements[i] = vec4(canonical(displacement), 0.0);
  newIterates[i] = vec4(place, start.w);
}
