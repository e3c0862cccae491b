// Before pairs are listed by particle.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = SURFACE_LISTS_BINDING) writeonly buffer ListCounts { uint listCounts[]; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Cursors { uint cursors[]; };

void main() {
  uint i = thisEntry();
  if (i >= step.totalParticles || isSettled()) return;
  listCounts[i] = 0u;
  cursors[i] = 0u;
}
