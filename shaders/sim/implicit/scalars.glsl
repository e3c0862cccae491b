// What conjugate gradients and the line search have come to so far. Passes over particles read it, and set flags at most.
layout(std430, binding = SCALARS_BINDING) buffer Scalars { ImplicitScalars scalars; };
#define GROUPS_DONE scalars.groupsDone

bool frictionFollows() { return scalars.newtonSteps < FRICTION_FOLLOWS; }
