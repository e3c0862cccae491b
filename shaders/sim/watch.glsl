// The watchdog: a pass tests what it writes, by bits (comparisons hide NaN), and notes the lowest particle that went
// wrong in the row of this step. Nobody reads it until the host asks (src/solver/divergence.h).
layout(std430, binding = WATCH_BINDING) buffer Watch { uint watchRow[PASSES]; };

// What went wrong first in this invocation.
uint divergencePass = uint(PASSES), divergenceCode = NO_DIVERGENCE;

// Whether a sum of squares is larger than the limit, infinite or NaN; the twin of src/core/exact_math.h.
bool isBeyond(float square, float limit) { return floatBitsToUint(square) > floatBitsToUint(limit); }
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

void noteDivergence(uint pass, uint particle, uint reason) {
  if (pass >= divergencePass) return;
  divergencePass = pass;
  divergenceCode = particle * 4u + reason;
}

// For what a pass stores as velocity. It answers for the position, too: that moves along, by h v or by h times the
// change.
void watchVelocity(uint pass, uint particle, vec3 v) {
  precise float speedSquared = sumOfProducts(v, v);
  if (isBeyond(speedSquared, step.maxSpeedSquared))
    noteDivergence(pass, particle, isFinite(speedSquared) ? REASON_RUNAWAY_SPEED : REASON_NON_FINITE);
}

// Once, at the end of a pass: on drivers that run both sides of a branch an atomic costs whether it is needed or not.
void reportDivergence() {
  if (divergencePass != uint(PASSES)) atomicMin(watchRow[divergencePass], divergenceCode);
}
