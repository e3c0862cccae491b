// After the guard: what each particle keeps of its motion.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = NEW_POSITIONS_BINDING) buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) buffer NewVelocities { vec4 newVelocities[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) readonly buffer Kept { uint kept[]; };
layout(std430, binding = SURFACE_COUNTS_BINDING) readonly buffer SafeVelocities { vec4 safeVelocities[]; };

void main() {
  uint i = thisEntry();
  if (isSettled()) {
    // The end of the step has been done once more, without what the guard has corrected.
    if (i >= step.totalParticles || state.tooMany == 2u || (state.tooNear[0] == 0u && state.isPressed == 0u)) return;
    newPositions[i] = texelFetch(surfaceStarts, int(i));
    newVelocities[i] = safeVelocities[i];
    return;
  }
  if (i == 0u) state.crowdedSteps += state.tooMany == 1u ? 1u : 0u;
  if (i >= step.totalParticles || state.tooMany == 2u) return;
  float part = uintBitsToFloat(kept[i]);
  if (!(part < 1.0)) return;
  atomicAdd(state.shortened, 1u);
  if (atomicExchange(state.isGuarded, 1u) == 0u) atomicAdd(state.guardedSteps, 1u);
  vec4 start = texelFetch(surfaceStarts, int(i));
  vec3 motion = motionAt(i);
  precise vec3 place = start.xyz + part * motion;
  precise vec3 lost = (1.0 - part) * motion;
  precise vec3 velocity = newVelocities[i].xyz - step.inverseTimeStep * lost;
  newPositions[i] = vec4(canonical(place), start.w);
  if (start.w > 0.0) {
    newVelocities[i] = vec4(canonical(velocity), 0.0);
    return;
  }
  float squared = sumOfProducts(lost, lost);
  precise float lag = squared * inverseSquareRoot(squared);
  atomicMax(state.pinLag, floatBitsToUint(canonical(lag)));
}
