// The incident springs of a particle one after the other, for passes that look at all of them.
#include "sim/springs.glsl"

const bool hasLimitSprings = HAS_LIMIT_SPRINGS != 0;

const uint INCIDENT_SPRINGS = 12u;
const ivec2 toEnd[12] = ivec2[12](ivec2(-1, 0), ivec2(0, -1), ivec2(-1, -1), ivec2(1, -1), ivec2(-2, 0), ivec2(0, -2),
                                  ivec2(1, 0), ivec2(2, 0), ivec2(-1, 1), ivec2(0, 1), ivec2(1, 1), ivec2(0, 2));
const uint slotOf[12] = uint[12](TO_LEFT, TO_UPPER, TO_UPPER_LEFT, TO_UPPER_RIGHT, TO_SECOND_LEFT, TO_SECOND_UPPER, TO_LEFT,
                                 TO_SECOND_LEFT, TO_UPPER_RIGHT, TO_UPPER, TO_UPPER_LEFT, TO_SECOND_UPPER);
const uint OWNED_SPRINGS = 6u;  // the first of them

struct IncidentSpring {
  bool exists;
  uint other;  // particle
  float stiffness, restLength, limitLength;
};

IncidentSpring incidentSpring(GridPoint p, uint k, uint cut) {
  uint slot = slotOf[k];
  uint column = uint(int(p.column) + toEnd[k].x), row = uint(int(p.row) + toEnd[k].y);  // before the grid: beyond it
  if (!enabled(slot) || column >= step.columns || row >= step.rows || !isIntact(cut, k))
    return IncidentSpring(false, 0u, 0.0, 0.0, 0.0);
  uint other = step.firstParticle + row * step.columns + column;
  uint owner = k < OWNED_SPRINGS ? p.index : other;
  precise float rest = restLength(slot, owner);
  precise float limit = step.springs[slot].limitLength;
  if (hasRestLengthTable) limit = step.limitFactor * rest;
  return IncidentSpring(true, other, stiffness(p, slot), rest, limit);
}

// The Hessian of a spring between particles d apart, projected or exact: across 1 + along d d^T.
struct SpringBlock {
  float across, along;
};

SpringBlock springBlock(vec3 d, IncidentSpring spring, bool isExact) {
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float len = lengthSquared * inverseLength;
  precise float tension = spring.stiffness * (len - spring.restLength);
  precise float whole = spring.stiffness;
  if (hasLimitSprings) {
    precise float over = len - spring.limitLength;
    precise float added = step.limitStiffness * over;
    if (over > 0.0) {
      tension = tension + added;
      whole = whole + step.limitStiffness;
    }
  }
  precise float scale = tension * inverseLength;
  float across = isExact || scale > 0.0 ? scale : 0.0;
  precise float along = (whole - across) * (inverseLength * inverseLength);
  return SpringBlock(across, along);
}

// What springs that are longer than limitLength add to their forces in `implicit`.
vec3 addLimitSprings(GridPoint p, vec3 force) {
  vec3 x = positionAt(p.index).xyz;
  uint cut = cutMaskOf(p.index);
  precise vec3 f = force;
  for (uint k = 0u; k < INCIDENT_SPRINGS; ++k) {
    IncidentSpring spring = incidentSpring(p, k, cut);
    if (!spring.exists) continue;
    precise vec3 d = positionAt(spring.other).xyz - x;
    precise float lengthSquared = sumOfProducts(d, d);
    precise float inverseLength = inverseSquareRoot(lengthSquared);
    precise float over = lengthSquared * inverseLength - spring.limitLength;
    precise float scale = (step.limitStiffness * over) * inverseLength;
    precise vec3 pull = scale * d;
    if (over > 0.0) f = f + pull;
  }
  return f;
}
