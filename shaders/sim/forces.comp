// Forces: of springs and air on every particle of a grid.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#if GATE != 0
#include "shared/implicit.h"
#include "sim/implicit/gate.glsl"
#endif

void main() {
#if GATE != 0
  if (isSkipped()) return;
#endif
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  forces[p.index] = vec4(gatherForces(p), 0.0);
  reportDivergence();
}
