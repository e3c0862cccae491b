// The strain limit of one spring: both ends move half of its excess towards each other, or the free end all of it.
struct SpringEnd {
  vec4 position;  // w: inverse mass
  vec3 velocity;
  bool moved;
};

void moveEnd(inout SpringEnd end, vec3 by) {
  precise vec3 newX = end.position.xyz + by;
  precise vec3 newV = end.velocity + step.inverseTimeStep * by;
  end = SpringEnd(vec4(canonical(newX), end.position.w), canonical(newV), true);
}

bool isTooLong(vec3 a, vec3 b, float limit) {
  precise vec3 d = b - a;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float limitSquared = limit * limit;
  return limitSquared < lengthSquared;
}

void limitSpring(inout SpringEnd a, inout SpringEnd b, float limit) {
  precise vec3 d = b.position.xyz - a.position.xyz;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float limitSquared = limit * limit;
  bool freeA = a.position.w > 0.0, freeB = b.position.w > 0.0;
  if (!(limitSquared < lengthSquared) || !(freeA || freeB)) return;
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float len = lengthSquared * inverseLength;
  precise float excess = (len - limit) * inverseLength;
  precise float share = freeA && freeB ? 0.5 * excess : excess;
  precise vec3 by = share * d;
  if (freeA) moveEnd(a, by);
  if (freeB) moveEnd(b, -by);
}

const ivec2 toOtherEnd[6] =
    ivec2[6](ivec2(-1, 0), ivec2(0, -1), ivec2(-1, -1), ivec2(1, -1), ivec2(-2, 0), ivec2(0, -2));

// How long a spring of the grid may be.
float longestOf(uint slot, uint owner) {
  precise float limit = step.springs[slot].limitLength;
  if (hasRestLengthTable)
    limit = step.limitFactor * texelFetch(restLengths, int(slot * step.totalParticles + owner)).x;
  return limit;
}
