// Force and torque on the aggregates of a level. Where others are to follow, the last work group goes on alone: down to the
// coarsest level, A^-1 r there, and back up with the corrections of all but the vertices that it came from. With
// UPDATES_SOLUTION, residuals of particles are those before the solution was updated; their new ones are stored later
// (sim/implicit/prolong_particles.comp).
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/vertices.glsl"
#include "sim/implicit/updated_solution.glsl"
#include "sim/last_group.glsl"

layout(std140, binding = LEVEL_PARAMS_BINDING) uniform LevelsBlock { LevelsInARow row; };
layout(std430, binding = RESIDUALS_BINDING) coherent buffer Residuals { vec4 allResiduals[]; };
layout(std430, binding = CORRECTIONS_BINDING) coherent buffer Corrections { vec4 allCorrections[]; };

vec3 residualAt(uint i) {
#if UPDATES_SOLUTION
  return updatedResidual(i);
#else
  return texelFetch(residuals, int(i)).xyz;
#endif
}
RigidVector residualOn(uint coarse) {
  int i = entryOfVertex(coarse);
  return RigidVector(allResiduals[i].xyz, allResiduals[i + 1].xyz);
}
RigidVector correctionOn(uint coarse) {
  int i = entryOfVertex(coarse);
  return RigidVector(allCorrections[i].xyz, allCorrections[i + 1].xyz);
}
#include "sim/implicit/restriction.glsl"
#include "sim/implicit/prolongation.glsl"
#include "sim/implicit/dense.glsl"

void restrictTo(uint coarse) {
  RigidVector force = restricted(coarse);
  int i = entryOfVertex(coarse);
  allResiduals[i] = vec4(force.translation, 0.0);
  allResiduals[i + 1] = vec4(force.rotation, 0.0);
}

void storeCorrection(uint coarse, RigidVector correction) {
  int i = entryOfVertex(coarse);
  allCorrections[i] = vec4(correction.translation, 0.0);
  allCorrections[i + 1] = vec4(correction.rotation, 0.0);
}

// Of the coarsest level.
DensePart partWith(uint coarse) {
  uint number = row.firstPart, end = row.endPart;
  while (end - number > 1u) {
    uint middle = (number + end) / 2u;
    bool isBehind = coarse < densePartAt(middle).first;
    number = isBehind ? number : middle;
    end = isBehind ? middle : end;
  }
  return densePartAt(number);
}

void main() {
  if (isSkipped()) return;
  uint entry = gl_GlobalInvocationID.x, lane = gl_LocalInvocationIndex, lanes = gl_WorkGroupSize.x;
  if (entry < row.levels[0].coarseCount) restrictTo(row.levels[0].coarseFirst + entry);
  if (row.firstPart == row.endPart || !isLastGroupOf(gl_NumWorkGroups.x)) return;
  for (uint n = 1u; n < row.count; ++n) {
    for (uint k = lane; k < row.levels[n].coarseCount; k += lanes) restrictTo(row.levels[n].coarseFirst + k);
    awaitGroup();
  }
  LevelParams coarsest = row.levels[row.count - 1u];
  for (uint k = lane; k < coarsest.coarseCount; k += lanes) {
    uint coarse = coarsest.coarseFirst + k;
    DensePart part = partWith(coarse);
    storeCorrection(coarse, solvedFor(part, coarse - part.first));
  }
  for (uint n = row.count - 1u; n > 0u; --n) {
    awaitGroup();
    for (uint k = lane; k < row.levels[n].fineCount; k += lanes) {
      uint coarse = row.levels[n].fineFirst - step.totalParticles + k;
      storeCorrection(coarse, correctionOfCoarse(coarse, residualOn(coarse)));
    }
  }
}
