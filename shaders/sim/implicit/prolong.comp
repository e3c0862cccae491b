// Corrections of a level: its own, D^-1 r, and what the aggregates that a vertex hangs on make of it. Pinned particles get 0.
#include "sim/implicit/level.glsl"

layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

Factors factorsAt(uint i) {
  return Factors(texelFetch(factors, int(2u * i)).xyz, texelFetch(factors, int(2u * i + 1u)).xyz);
}

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.fineCount)) return;
  uint vertex = level.fineFirst + i;
  vec3 place = placeOf(vertex);
  precise vec3 translation = vec3(0.0);
  precise vec3 rotation = vec3(0.0);
  uvec2 range = rangeAt(prolongationStarts, vertex);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(prolongation, n);
    RigidVector motion = rigidAt(corrections, weight.vertex);
    precise vec3 arm = place - centerAt(weight.vertex);
    precise vec3 moved = motion.translation + crossProduct(motion.rotation, arm);
    translation = translation + weight.weight * moved;
    rotation = rotation + weight.weight * motion.rotation;
  }
  if (vertex < step.totalParticles) {
    precise vec3 correction = solveFor(factorsAt(vertex), texelFetch(residuals, int(vertex)).xyz) + translation;
    newCorrections[vertex] = vec4(iterateAt(vertex).w == 0.0 ? vec3(0.0) : canonical(correction), 0.0);
    return;
  }
  uint coarse = vertex - step.totalParticles;
  RigidVector minus = timesRigid(loadBlock(coarseInverses, coarse), rigidAt(residuals, coarse));
  precise vec3 ownTranslation = translation - minus.translation;
  precise vec3 ownRotation = rotation - minus.rotation;
  int entry = entryOfVertex(coarse);
  newCorrections[entry] = vec4(canonical(ownTranslation), 0.0);
  newCorrections[entry + 1] = vec4(canonical(ownRotation), 0.0);
}
