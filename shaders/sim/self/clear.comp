// Building the hash, 1: empty buckets.
#include "sim/self/particles.glsl"

layout(std430, binding = BUCKETS_BINDING) writeonly buffer Buckets { uint buckets[]; };

void main() {
  if (gl_GlobalInvocationID.x <= self.bucketMask) buckets[gl_GlobalInvocationID.x] = 0u;
}
