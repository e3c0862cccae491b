// The end of a step: counts it, and opens the gates for the next one.
#include "shared/implicit.h"

layout(local_size_x = 1) in;

layout(std430, binding = SCALARS_BINDING) buffer Scalars { ImplicitScalars scalars; };

void main() {
  scalars.steps += 1u;
  scalars.unconvergedSteps += 1u - scalars.isStepSolved;
  scalars.allIterations += scalars.iterations;
  scalars.allNewtonSteps += scalars.newtonSteps;
  scalars.isStepSolved = 0u;
  scalars.isSystemSolved = 0u;
  scalars.iterations = 0u;
  scalars.newtonSteps = 0u;
}
