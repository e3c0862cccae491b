// The blocks of a coarse level's vertices, from the next finer one (src/solver/implicit.h).
#include "sim/implicit/level.glsl"

layout(std430, binding = FACTORS_BINDING) writeonly buffer FactorsOut { vec4 newFactors[]; };
layout(std430, binding = BLOCKS_BINDING) writeonly buffer Blocks { vec4 newBlocks[]; };

void main() {
  uvec2 coarse = gl_GlobalInvocationID.xy;
  if (coarse.x >= level.coarseColumns || coarse.y >= level.coarseRows) return;
  Fine fine = fineAround(coarse);
  Symmetric stiffness = Symmetric(gatherFine(blocks, fine, 4u, 0u), gatherFine(blocks, fine, 4u, 1u));
  Symmetric inertia = Symmetric(gatherFine(blocks, fine, 4u, 2u), gatherFine(blocks, fine, 4u, 3u));
  Symmetric block = sumOf(scaled(level.stiffnessFactor, stiffness), scaled(level.inertiaFactor, inertia));
  precise vec3 diagonal = block.diagonal + vec3(level.bending);
  Factors f = factorize(Symmetric(diagonal, block.others));
  uint i = level.coarseFirst + coarse.y * level.coarseColumns + coarse.x;
  newFactors[2u * i] = vec4(f.lower, 0.0);
  newFactors[2u * i + 1u] = vec4(f.inverse, 0.0);
  newBlocks[4u * i] = vec4(stiffness.diagonal, 0.0);
  newBlocks[4u * i + 1u] = vec4(stiffness.others, 0.0);
  newBlocks[4u * i + 2u] = vec4(inertia.diagonal, 0.0);
  newBlocks[4u * i + 3u] = vec4(inertia.others, 0.0);
}
