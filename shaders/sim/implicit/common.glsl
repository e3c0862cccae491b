// What the passes of an implicit step see beside sim/blocks.glsl. The method is at src/solver/implicit.h, the twins are in
// src/solver/cpu/implicit_passes.cpp, implicit_ends.cpp and multilevel.cpp.
#include "shared/implicit.h"
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/implicit/gate.glsl"
#include "sim/implicit/symmetric.glsl"

layout(binding = RIGHT_HAND_SIDES_UNIT) uniform samplerBuffer rightHandSides;
layout(binding = AIR_BLOCKS_UNIT) uniform samplerBuffer airBlocks;
layout(binding = DISPLACEMENTS_UNIT) uniform samplerBuffer displacements;
layout(binding = ITERATES_UNIT) uniform samplerBuffer iterates;
layout(binding = INCREMENTS_UNIT) uniform samplerBuffer increments;
layout(binding = STARTS_UNIT) uniform samplerBuffer starts;

vec4 iterateAt(uint i) { return texelFetch(iterates, int(i)); }

Symmetric airBlockAt(uint i) {
  return Symmetric(texelFetch(airBlocks, int(2u * i)).xyz, texelFetch(airBlocks, int(2u * i + 1u)).xyz);
}

// One invocation a particle, of all pieces.
uint thisParticle() { return gl_GlobalInvocationID.y * PARTICLES_A_ROW + gl_GlobalInvocationID.x; }
bool isParticle(uint i) { return gl_GlobalInvocationID.x < PARTICLES_A_ROW && i < step.totalParticles; }
