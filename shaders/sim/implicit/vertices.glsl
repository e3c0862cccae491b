// The vertices of all levels of the preconditioner, and what joins them (src/solver/hierarchy.h); the twin of
// src/solver/cpu/multilevel.cpp.
#include "sim/implicit/common.glsl"
#include "sim/implicit/rigid_block.glsl"

layout(binding = CENTERS_UNIT) uniform samplerBuffer centers;
layout(binding = PROLONGATION_STARTS_UNIT) uniform usamplerBuffer prolongationStarts;
layout(binding = PROLONGATION_UNIT) uniform usamplerBuffer prolongation;
layout(binding = COARSE_PAIRS_UNIT) uniform usamplerBuffer coarsePairs;
layout(binding = COARSE_SOURCES_UNIT) uniform usamplerBuffer coarseSources;

// One invocation an entry: a coarse or fine vertex of the level, or a block.
uint thisEntry() { return gl_GlobalInvocationID.y * PARTICLES_A_ROW + gl_GlobalInvocationID.x; }
bool isEntry(uint i, uint count) { return gl_GlobalInvocationID.x < PARTICLES_A_ROW && i < count; }

vec3 centerAt(uint coarse) { return texelFetch(centers, int(coarse)).xyz; }

// Where a vertex is: a particle, or the center of an aggregate.
vec3 placeOf(uint vertex) {
  return vertex < step.totalParticles ? iterateAt(vertex).xyz : centerAt(vertex - step.totalParticles);
}

// Places are from the first particle: where the cloth is in the world costs forces and motions no digits.
vec3 fromOrigin(vec3 place) {
  precise vec3 offset = place - iterateAt(0u).xyz;
  return offset;
}

// Of a coarse vertex, behind the particles.
int entryOfVertex(uint coarse) { return int(step.totalParticles + VERTEX_TEXELS * coarse); }
RigidVector rigidAt(samplerBuffer values, uint coarse) {
  int i = entryOfVertex(coarse);
  return RigidVector(texelFetch(values, i).xyz, texelFetch(values, i + 1).xyz);
}

struct Weight {
  uint vertex;
  float weight;
};
Weight weightAt(usamplerBuffer weights, uint n) {
  uvec2 stored = texelFetch(weights, int(n)).xy;
  return Weight(stored.x, uintBitsToFloat(stored.y));
}
uvec2 rangeAt(usamplerBuffer starts, uint i) { return uvec2(texelFetch(starts, int(i)).x, texelFetch(starts, int(i) + 1).x); }

// How much a vertex hangs on a coarse one; 0 if it does not.
float weightOn(uint vertex, uint coarse) {
  uvec2 range = rangeAt(prolongationStarts, vertex);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(prolongation, n);
    if (weight.vertex == coarse) return weight.weight;
  }
  return 0.0;
}
