// Passes of the hash that run over all particles at once, whatever their grid.
#include "sim/self/common.glsl"

layout(local_size_x = HASH_GROUP) in;

uint thisParticle() { return gl_GlobalInvocationID.x; }
