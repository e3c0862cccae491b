// Building the hash, 1: the histogram. A particle's rank in its bucket is in no particular order; nothing depends on it.
#include "sim/self/particles.glsl"

layout(binding = POSITIONS_TO_HASH_UNIT) uniform samplerBuffer positionsToHash;
layout(std430, binding = BUCKET_COUNTS_BINDING) buffer Counts { uint counts[]; };
layout(std430, binding = HASHED_BINDING) writeonly buffer Hashed { vec4 hashed[]; };

void main() {
  uint i = thisParticle();
  if (i >= self.particles) return;
  vec3 x = texelFetch(positionsToHash, int(i)).xyz;
  uint rank = atomicAdd(counts[bucketOf(cellOf(x))], 1u);
  hashed[i] = vec4(x, packedIndex(rank));
}
