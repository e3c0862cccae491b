// The watchdog's look at what the strain limit stored: once after all colours, which is cheaper than in each. An
// invocation takes a few points of a column, since most of its cost is in starting it.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"

void main() {
  uint column = gl_GlobalInvocationID.x, firstRow = gl_GlobalInvocationID.y * WATCHED_ROWS;
  if (column >= step.columns) return;
  for (uint row = firstRow; row < min(firstRow + WATCHED_ROWS, step.rows); ++row) {
    uint i = step.firstParticle + row * step.columns + column;
    watchVelocity(step.limitPass, i, texelFetch(velocitiesSoFar, int(i)).xyz);
  }
  reportDivergence();
}
