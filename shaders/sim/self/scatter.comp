// Building the hash, 3: every particle to its place in its bucket.
#include "sim/self/particles.glsl"

layout(std430, binding = HASHED_BINDING) writeonly buffer Sorted { vec4 sorted[]; };

void main() {
  uint i = thisParticle();
  if (i >= self.particles) return;
  vec4 x = texelFetch(hashedPositions, int(i));
  sorted[firstEntry(bucketOf(cellOf(x.xyz))) + unpackedIndex(x.w)] = vec4(x.xyz, packedIndex(i));
}
