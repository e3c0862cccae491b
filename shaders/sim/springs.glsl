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

// Of a spring at grid point p. A material's springs along a border count half.
float stiffness(GridPoint p, uint slot) {
  float inside = step.springs[slot].stiffness;
  if (!hasMaterial) return inside;
  bool onBorder = slot == TO_LEFT    ? p.row == 0u || p.row + 1u == step.rows
                  : slot == TO_UPPER ? p.column == 0u || p.column + 1u == step.columns
                                     : false;
  precise float halved = 0.5 * inside;
  return onBorder ? halved : inside;
}

// The force on the particle at x from the spring in `slot` of `owner`, whose other end is `other`.
vec3 springTo(GridPoint p, vec3 x, uint other, uint slot, uint owner) {
  return springForce(x, positionAt(other).xyz, stiffness(p, slot), restLength(slot, owner));
}

// The same, and tells the watchdog how long it is: once a spring, at its owner.
bool overlong = false;
vec3 ownSpringTo(GridPoint p, vec3 x, uint other, uint slot) {
  vec3 end = positionAt(other).xyz;
  precise vec3 d = end - x;
  precise float lengthSquared = sumOfProducts(d, d);
  overlong = overlong || isBeyond(lengthSquared, step.springs[slot].maxLengthSquared);
  return springForce(x, end, stiffness(p, slot), restLength(slot, p.index));
}

vec3 gatherSprings(GridPoint p, vec3 x) {
  const uint i = p.index;
  const uint w = step.columns;
  const bool left = p.column >= 1u, right = p.column + 1u < w;
  const bool upper = p.row >= 1u, lower = p.row + 1u < step.rows;
  const uint cut = cutMaskOf(i);
  precise vec3 f = vec3(0.0);

  if (enabled(TO_LEFT) && left && isIntact(cut, 0u)) f = f + ownSpringTo(p, x, i - 1u, TO_LEFT);
  if (enabled(TO_UPPER) && upper && isIntact(cut, 1u)) f = f + ownSpringTo(p, x, i - w, TO_UPPER);
  if (enabled(TO_UPPER_LEFT) && upper && left && isIntact(cut, 2u)) f = f + ownSpringTo(p, x, i - w - 1u, TO_UPPER_LEFT);
  if (enabled(TO_UPPER_RIGHT) && upper && right && isIntact(cut, 3u)) f = f + ownSpringTo(p, x, i - w + 1u, TO_UPPER_RIGHT);
  if (enabled(TO_SECOND_LEFT) && p.column >= 2u && isIntact(cut, 4u)) f = f + ownSpringTo(p, x, i - 2u, TO_SECOND_LEFT);
  if (enabled(TO_SECOND_UPPER) && p.row >= 2u && isIntact(cut, 5u)) f = f + ownSpringTo(p, x, i - 2u * w, TO_SECOND_UPPER);

  if (enabled(TO_LEFT) && right && isIntact(cut, 6u)) f = f + springTo(p, x, i + 1u, TO_LEFT, i + 1u);
  if (enabled(TO_SECOND_LEFT) && p.column + 2u < w && isIntact(cut, 7u)) f = f + springTo(p, x, i + 2u, TO_SECOND_LEFT, i + 2u);
  if (enabled(TO_UPPER_RIGHT) && lower && left && isIntact(cut, 8u)) f = f + springTo(p, x, i + w - 1u, TO_UPPER_RIGHT, i + w - 1u);
  if (enabled(TO_UPPER) && lower && isIntact(cut, 9u)) f = f + springTo(p, x, i + w, TO_UPPER, i + w);
  if (enabled(TO_UPPER_LEFT) && lower && right && isIntact(cut, 10u)) f = f + springTo(p, x, i + w + 1u, TO_UPPER_LEFT, i + w + 1u);
  if (enabled(TO_SECOND_UPPER) && p.row + 2u < step.rows && isIntact(cut, 11u)) f = f + springTo(p, x, i + 2u * w, TO_SECOND_UPPER, i + 2u * w);
  if (overlong) noteDivergence(PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  return f;
}
