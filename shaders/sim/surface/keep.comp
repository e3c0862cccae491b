// What particles keep of their motion: all of it before the guard, or what its rounds so far have left.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = SURFACE_COUNTS_BINDING) writeonly buffer Kept { uint kept[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) buffer NewlyKept { uint newlyKept[]; };
#if CLEARS
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Corrections { ivec4 corrections[]; };
#endif

void main() {
  uint i = thisEntry();
  if (i >= step.totalParticles || isSettled()) return;
#if CLEARS
  newlyKept[i] = floatBitsToUint(1.0);
  corrections[i] = ivec4(0);
#endif
  kept[i] = newlyKept[i];
}
