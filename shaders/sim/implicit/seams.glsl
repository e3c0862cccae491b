// The springs of seams in an implicit step; the twin of src/solver/cpu/seam_passes.cpp. No strain limit acts on them.
#include "sim/seams.glsl"

const float NO_LIMIT_LENGTH = 1e30;
const float AT_ONE_PLACE = 8.6736174e-19;  // squared, 2^-60 [m^2]

IncidentSpring seamAsSpring(SeamSpring spring) {
  return IncidentSpring(true, spring.other, spring.stiffness, spring.restLength, NO_LIMIT_LENGTH);
}

// That of a spring, but where both ends are at one place, or are to be: there it is as stiff in all directions.
SpringBlock seamBlock(vec3 d, SeamSpring spring) {
  precise float lengthSquared = sumOfProducts(d, d);
  SpringBlock s = springBlock(d, seamAsSpring(spring), false);
  if (spring.restLength == 0.0 || lengthSquared < AT_ONE_PLACE) return SpringBlock(spring.stiffness, 0.0);
  return s;
}

Symmetric addSeamBlocks(uint i, Symmetric block) {
  uvec2 range = seamsOf(i);
  for (uint n = range.x; n < range.y; ++n) {
    SeamSpring spring = seamSpring(n);
    precise vec3 d = iterateAt(spring.other).xyz - iterateAt(i).xyz;
    SpringBlock s = seamBlock(d, spring);
    Symmetric outer = outerProduct3(s.along, d);
    precise vec3 diagonal = outer.diagonal + vec3(s.across);
    block = sumOf(block, Symmetric(diagonal, outer.others));
  }
  return block;
}

// POSITIONS_UNIT: the directions.
vec3 addSeamProducts(uint i, vec3 force) {
  uvec2 range = seamsOf(i);
  precise vec3 sum = force;
  for (uint n = range.x; n < range.y; ++n) {
    SeamSpring spring = seamSpring(n);
    precise vec3 d = iterateAt(spring.other).xyz - iterateAt(i).xyz;
    precise vec3 e = positionAt(spring.other).xyz - positionAt(i).xyz;
    SpringBlock s = seamBlock(d, spring);
    precise vec3 f = s.across * e + (s.along * sumOfProducts(d, e)) * d;
    sum = sum + f;
  }
  return sum;
}
