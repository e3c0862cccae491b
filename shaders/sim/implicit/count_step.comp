// The end of a step: counts it, and opens the gates for the next one.
#include "shared/implicit.h"
#include "shared/step_params.h"

layout(local_size_x = 1) in;

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(std430, binding = SCALARS_BINDING) buffer Scalars { ImplicitScalars scalars; };

void main() {
  bool isSolved = scalars.isStepSolved == 1u, isUsual = scalars.hasNewContacts == 0u;
  scalars.steps += 1u;
  scalars.unconvergedSteps += isSolved ? 0u : 1u;
  scalars.secondOrderSteps += step.secondRate > 0.0 && scalars.usualSteps >= USUAL_STEPS && isUsual ? 1u : 0u;
  scalars.allIterations += scalars.iterations;
  scalars.allNewtonSteps += scalars.newtonSteps;
  bool isSmall = scalars.isStepSolved != 0u && scalars.lastUpdate <= step.tolerance;
  scalars.usualSteps = isSmall && isUsual && scalars.isDisturbed == 0u ? scalars.usualSteps + 1u : 0u;
  scalars.hasNewContacts = 0u;
  scalars.isDisturbed = 0u;
  scalars.hessian = HESSIAN_PROJECTED;
  scalars.isStepSolved = 0u;
  scalars.isSystemSolved = 0u;
  scalars.iterations = 0u;
  scalars.newtonSteps = 0u;
}
