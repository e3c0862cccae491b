// The start of a search. LATER: of a round that goes on from where motion was cut short, if there was any.
#include "sim/surface/common.glsl"

layout(local_size_x = 1) in;

layout(std430, binding = WATCH_BINDING) readonly buffer Watch { uint watchRow[PASSES]; };

void main() {
#if SEARCHES_TOUCHING
#if !LATER
  state.isLater = 0u;
  state.isSettled = 0u;
  state.isPressed = 0u;
#endif
  if (isSettled()) return;
  state.tooMany = 0u;
#else
  if (isSettled()) return;
  for (uint round = 0u; round < uint(GUARD_ROUNDS); ++round) state.tooNear[round] = 0u;
  state.isGuarded = 0u;
#endif
  state.isFlat = 0u;
  precise vec3 sum = vec3(0.0);
  for (uint k = 0u; k < SHIFT_SAMPLES; ++k) sum = sum + motionAt(k * step.totalParticles / SHIFT_SAMPLES);
  precise vec3 mean = (1.0 / float(SHIFT_SAMPLES)) * sum;
  mean = canonical(mean);
  state.shiftX = mean.x;
  state.shiftY = mean.y;
  state.shiftZ = mean.z;
  for (uint pass = 0u; pass < uint(PASSES); ++pass)
    if (watchRow[pass] != NO_DIVERGENCE) state.tooMany = 2u;
}
