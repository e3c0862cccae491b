// What the pairs that are too near want of a particle: the mean of it, where they want more than all.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = NEW_POSITIONS_BINDING) buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) buffer NewVelocities { vec4 newVelocities[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) buffer Corrections { ivec4 corrections[]; };

// In two halves, each of which converts exactly.
float fromQuanta(int sum) {
  precise float value = float(sum >> 12) * 4096.0 + float(sum & 4095);
  return value;
}

void main() {
  uint i = thisEntry();
  if (i >= step.totalParticles || isSettled() || state.tooMany == 2u) return;
  ivec4 sum = corrections[i];
  vec4 place = newPositions[i];
  if (sum.w == 0 || !(place.w > 0.0)) return;
  float weight = reciprocal(float(sum.w < CORRECTION_WEIGHT ? CORRECTION_WEIGHT : sum.w));
  precise float part = (surface.quantum * float(CORRECTION_WEIGHT)) * weight;
  precise vec3 moved = part * vec3(fromQuanta(sum.x), fromQuanta(sum.y), fromQuanta(sum.z));
  precise vec3 end = place.xyz + moved;
  precise vec3 velocity = newVelocities[i].xyz + step.inverseTimeStep * moved;
  float squared = sumOfProducts(moved, moved);
  precise float far = squared * inverseSquareRoot(squared);
  atomicMax(state.largestCorrection, floatBitsToUint(canonical(far)));
  newPositions[i] = vec4(canonical(end), place.w);
  newVelocities[i] = vec4(canonical(velocity), 0.0);
  corrections[i] = ivec4(0);
}
