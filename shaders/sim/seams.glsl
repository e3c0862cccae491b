// The springs of seams at a particle, gathered over a list; the twin is src/solver/cpu/seam_passes.cpp.
#include "shared/seams.h"

layout(binding = SEAMS_UNIT) uniform usamplerBuffer seamSprings;

struct SeamSpring {
  uint other;  // particle
  float stiffness, restLength;
};

uvec2 seamsOf(uint i) { return uvec2(texelFetch(seamSprings, int(i)).x, texelFetch(seamSprings, int(i) + 1).x); }

uvec4 seamEntry(uint n) { return texelFetch(seamSprings, int(step.totalParticles + 1u + n)); }

SeamSpring seamSpring(uint n) {
  uvec4 entry = seamEntry(n);
  precise float rest = step.seams[entry.y].lengthFactor * uintBitsToFloat(entry.w);
  return SeamSpring(entry.x, uintBitsToFloat(entry.z), rest);
}

bool areSewn(uint i, uint j) {
  uvec2 range = seamsOf(i);
  for (uint n = range.x; n < range.y; ++n)
    if (seamEntry(n).x == j) return true;
  return false;
}
