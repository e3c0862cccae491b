// Before the first step from a state that was handed in: is it finite at all? Beyond this, passes watch what they write.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/watch.glsl"

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 x = positionAt(p.index);
  vec3 v = velocityAt(p.index);
  bool finite = isFinite(x.x) && isFinite(x.y) && isFinite(x.z) && isFinite(x.w) && isFinite(v.x) && isFinite(v.y) &&
                isFinite(v.z);
  if (!finite) noteDivergence(PASS_START, p.index, REASON_NON_FINITE);
  reportDivergence();
}
