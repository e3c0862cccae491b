// How the velocity at the end of a step comes from the displacement d: rate (d - carried). Backward Euler, or of second order
// from the step before (src/solver/implicit.h). Needs sim/implicit/scalars.glsl.
const bool hasHistory = HAS_HISTORY != 0;
layout(binding = HISTORIES_UNIT) uniform samplerBuffer histories;

struct TimeScheme {
  bool isSecondOrder;
  float rate, inertia, guessTime, gravityTime;
};
TimeScheme timeScheme() {
  if (hasHistory && scalars.usualSteps >= USUAL_STEPS && scalars.hasNewContacts == 0u)
    return TimeScheme(true, step.secondRate, step.secondInertia, step.secondGuessTime, step.secondTime);
  return TimeScheme(false, step.inverseTimeStep, step.inertia, step.guessTime, step.timeStep);
}

vec3 movedBefore(uint i) { return texelFetch(histories, int(2u * i)).xyz; }
vec3 acceleratedBefore(uint i) { return texelFetch(histories, int(2u * i + 1u)).xyz; }
