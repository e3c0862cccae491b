// How the energy changes along the Newton step; the twin of src/solver/cpu/implicit_laws.h.
const vec4 lengthsTried = vec4(1.0, 0.5, 0.25, 0.125);

vec3 incrementAt(uint i) { return texelFetch(increments, int(i)).xyz; }

float springChange(vec3 d, vec3 e, float l, IncidentSpring spring) {
  precise vec3 moved = d + l * e;
  precise float squaredBefore = sumOfProducts(d, d);
  precise float squaredAfter = sumOfProducts(moved, moved);
  precise float before = squaredBefore * inverseSquareRoot(squaredBefore);
  precise float after = squaredAfter * inverseSquareRoot(squaredAfter);
  precise float sum = (before + after) + uintBitsToFloat(0x0d800000u);  // 2^-100
  precise float change = (l * (2.0 * sumOfProducts(d, e) + l * sumOfProducts(e, e))) * reciprocal(sum);
  precise float energy = (spring.stiffness * change) * ((before - spring.restLength) + (after - spring.restLength));
  precise float limit = 0.0;
  if (hasLimitSprings) {
    precise float pastBefore = before - spring.limitLength;
    precise float pastAfter = after - spring.limitLength;
    precise float overBefore = larger(pastBefore, 0.0);
    precise float overAfter = larger(pastAfter, 0.0);
    limit = (step.limitStiffness * (overAfter - overBefore)) * (overAfter + overBefore);
  }
  precise float result = 0.5 * (energy + limit);
  return result;
}
