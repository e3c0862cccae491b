// Corrections of the vertices of a level.
#include "sim/implicit/level.glsl"
#include "sim/implicit/vectors.glsl"

layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

RigidVector correctionOn(uint coarse) { return rigidAt(corrections, coarse); }
#include "sim/implicit/prolongation.glsl"

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.fineCount)) return;
  uint vertex = level.fineFirst + i;
  if (vertex < step.totalParticles) {
    newCorrections[vertex] = vec4(correctionOfParticle(vertex, texelFetch(residuals, int(vertex)).xyz), 0.0);
    return;
  }
  uint coarse = vertex - step.totalParticles;
  RigidVector correction = correctionOfCoarse(coarse, rigidAt(residuals, coarse));
  int entry = entryOfVertex(coarse);
  newCorrections[entry] = vec4(correction.translation, 0.0);
  newCorrections[entry + 1] = vec4(correction.rotation, 0.0);
}
