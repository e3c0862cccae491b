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

// Whether a seam joins them, or one and a neighbour of the other (src/cloth/seam_neighbours.h).
bool areNearSeam(uint i, uint j) {
  int behind = int(step.totalParticles + 1u + texelFetch(seamSprings, int(step.totalParticles)).x);
  uint end = texelFetch(seamSprings, int(i) + 1).y;
  for (uint n = texelFetch(seamSprings, int(i)).y; n < end; ++n)
    if (texelFetch(seamSprings, behind + int(n)).x == j) return true;
  return false;
}
