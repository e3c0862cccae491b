// Whether the step, or the linear system, is solved already: then its further passes do nothing.
#if GATE != GATE_NONE
#include "sim/implicit/scalars.glsl"
#endif
bool isSkipped() {
#if GATE == GATE_STEP
  return scalars.isStepSolved != 0u;
#elif GATE == GATE_SYSTEM
  return scalars.isSystemSolved != 0u || scalars.isStepSolved != 0u;
#else
  return false;
#endif
}
