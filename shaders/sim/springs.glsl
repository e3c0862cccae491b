// Springs of the grid. Every particle gathers its up to twelve in ascending number: the six it owns, then those owned by
// points with larger indices (src/cloth/cloth.h). Neighbours follow from the coordinates; nothing is looked up.

// Hooke's law: k (l - L) along the unit vector from a to b.
vec3 springForce(vec3 a, vec3 b, float stiffness, float restLength) {
  precise vec3 d = b - a;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float len = lengthSquared * inverseLength;
  precise float scale = (stiffness * (len - restLength)) * inverseLength;
  precise vec3 force = scale * d;
  return force;
}

const uint TO_LEFT = 0u, TO_UPPER = 1u, TO_UPPER_LEFT = 2u, TO_UPPER_RIGHT = 3u, TO_SECOND_LEFT = 4u, TO_SECOND_UPPER = 5u;

bool enabled(uint slot) { return (enabledSlots >> slot & 1u) != 0u; }

float restLength(uint slot, uint owner) {
  if (hasRestLengthTable) return texelFetch(restLengths, int(slot * step.totalParticles + owner)).x;
  return step.springs[slot].restLength;
}

// The force on the particle at x from the spring in `slot` of `owner`, whose other end is `other`.
vec3 springTo(vec3 x, uint other, uint slot, uint owner) {
  return springForce(x, positionAt(other).xyz, step.springs[slot].stiffness, restLength(slot, owner));
}

// The same, and tells the watchdog how long it is: once a spring, at its owner.
bool overlong = false;
vec3 ownSpringTo(vec3 x, uint other, uint slot, uint owner) {
  vec3 end = positionAt(other).xyz;
  precise vec3 d = end - x;
  precise float lengthSquared = sumOfProducts(d, d);
  overlong = overlong || isBeyond(lengthSquared, step.springs[slot].maxLengthSquared);
  return springForce(x, end, step.springs[slot].stiffness, restLength(slot, owner));
}

vec3 gatherSprings(GridPoint p, vec3 x) {
  const uint i = p.index;
  const uint w = step.columns;
  const bool left = p.column >= 1u, right = p.column + 1u < w;
  const bool upper = p.row >= 1u, lower = p.row + 1u < step.rows;
  const uint cut = cutMaskOf(i);
  precise vec3 f = vec3(0.0);

  if (enabled(TO_LEFT) && left && isLeft(cut, 0u)) f = f + ownSpringTo(x, i - 1u, TO_LEFT, i);
  if (enabled(TO_UPPER) && upper && isLeft(cut, 1u)) f = f + ownSpringTo(x, i - w, TO_UPPER, i);
  if (enabled(TO_UPPER_LEFT) && upper && left && isLeft(cut, 2u)) f = f + ownSpringTo(x, i - w - 1u, TO_UPPER_LEFT, i);
  if (enabled(TO_UPPER_RIGHT) && upper && right && isLeft(cut, 3u)) f = f + ownSpringTo(x, i - w + 1u, TO_UPPER_RIGHT, i);
  if (enabled(TO_SECOND_LEFT) && p.column >= 2u && isLeft(cut, 4u)) f = f + ownSpringTo(x, i - 2u, TO_SECOND_LEFT, i);
  if (enabled(TO_SECOND_UPPER) && p.row >= 2u && isLeft(cut, 5u)) f = f + ownSpringTo(x, i - 2u * w, TO_SECOND_UPPER, i);

  if (enabled(TO_LEFT) && right && isLeft(cut, 6u)) f = f + springTo(x, i + 1u, TO_LEFT, i + 1u);
  if (enabled(TO_SECOND_LEFT) && p.column + 2u < w && isLeft(cut, 7u)) f = f + springTo(x, i + 2u, TO_SECOND_LEFT, i + 2u);
  if (enabled(TO_UPPER_RIGHT) && lower && left && isLeft(cut, 8u)) f = f + springTo(x, i + w - 1u, TO_UPPER_RIGHT, i + w - 1u);
  if (enabled(TO_UPPER) && lower && isLeft(cut, 9u)) f = f + springTo(x, i + w, TO_UPPER, i + w);
  if (enabled(TO_UPPER_LEFT) && lower && right && isLeft(cut, 10u)) f = f + springTo(x, i + w + 1u, TO_UPPER_LEFT, i + w + 1u);
  if (enabled(TO_SECOND_UPPER) && p.row + 2u < step.rows && isLeft(cut, 11u)) f = f + springTo(x, i + 2u * w, TO_SECOND_UPPER, i + 2u * w);
  if (overlong) noteTrouble(PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  return f;
}
