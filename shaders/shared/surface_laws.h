// Distances of the parts of a surface, and how far they may move. Written once, in the words that GLSL and
// C++ share (src/solver/cpu/surface_laws.h).

// Where two parts are nearest: the place on a triangle a + u (b - a) + v (c - a), or on two segments.
struct NearestParts {
  vec3 way;  // from the second to the first [m]
  real u;
  real v;
  uint part;
};

LAW real partOf(real a, real whole) {
  const real zero = real(0.0), one = real(1.0), tiny = real(9.31322574615478515625e-10);  // 2^-30
  precise real least = (tiny * tiny) * tiny;
  precise real part = a * reciprocal(whole < least ? least : whole);
  return part < zero ? zero : one < part ? one : part;
}

// Ericson 2005, "Real-Time Collision Detection", 5.1.5.
LAW NearestParts nearestOnTriangle(vec3 p, vec3 a, vec3 b, vec3 c) {
  const real zero = real(0.0), one = real(1.0);
  precise vec3 ab = b - a;
  precise vec3 ac = c - a;
  precise vec3 ap = p - a;
  precise vec3 bp = p - b;
  precise vec3 cp = p - c;
  real d1 = sumOfProducts(ab, ap), d2 = sumOfProducts(ac, ap);
  real d3 = sumOfProducts(ab, bp), d4 = sumOfProducts(ac, bp);
  real d5 = sumOfProducts(ab, cp), d6 = sumOfProducts(ac, cp);
  precise real fromBC = d3 * d6 - d5 * d4;
  precise real fromCA = d5 * d2 - d1 * d6;
  precise real fromAB = d1 * d4 - d3 * d2;
  precise real towardsC = d4 - d3;
  precise real towardsB = d5 - d6;
  precise real alongAB = d1 - d3;
  precise real alongAC = d2 - d6;
  precise real alongBC = towardsC + towardsB;
  precise real area = (fromBC + fromCA) + fromAB;
  NearestParts nearest;
  nearest.u = zero;
  nearest.v = zero;
  nearest.part = NEAREST_CORNER;
  if (d1 <= zero && d2 <= zero) {
  } else if (zero <= d3 && d4 <= d3) {
    nearest.u = one;
    nearest.part = NEAREST_CORNER + 1u;
  } else if (zero <= d6 && d5 <= d6) {
    nearest.v = one;
    nearest.part = NEAREST_CORNER + 2u;
  } else if (fromAB <= zero && zero <= d1 && d3 <= zero) {
    nearest.u = partOf(d1, alongAB);
    nearest.part = NEAREST_SIDE;
  } else if (fromCA <= zero && zero <= d2 && d6 <= zero) {
    nearest.v = partOf(d2, alongAC);
    nearest.part = NEAREST_SIDE + 2u;
  } else if (fromBC <= zero && zero <= towardsC && zero <= towardsB) {
    nearest.v = partOf(towardsC, alongBC);
    precise real rest = one - nearest.v;
    nearest.u = rest;
    nearest.part = NEAREST_SIDE + 1u;
  } else {
    nearest.u = partOf(fromCA, area);
    nearest.v = partOf(fromAB, area);
    nearest.part = NEAREST_FACE;
  }
  precise vec3 way = ap - (nearest.u * ab + nearest.v * ac);
  nearest.way = way;
  return nearest;
}

// Of the segments from p to q and from a to b: p + u (q - p) and a + v (b - a). Its part is NEAREST_FACE
// where both lie inside.
LAW NearestParts nearestOnSegments(vec3 p, vec3 q, vec3 a, vec3 b) {
  const real zero = real(0.0), one = real(1.0), middle = real(0.5),
             parallel = real(9.5367431640625e-07);  // 2^-20
  precise vec3 along = q - p;
  precise vec3 other = b - a;
  precise vec3 between = p - a;
  real alongSquared = sumOfProducts(along, along), otherSquared = sumOfProducts(other, other);
  real both = sumOfProducts(along, other);
  real c = sumOfProducts(along, between), f = sumOfProducts(other, between);
  precise real product = alongSquared * otherSquared;
  precise real determinant = product - both * both;
  precise real towards = both * f - c * otherSquared;
  precise real least = parallel * product;
  NearestParts nearest;
  nearest.u = least < determinant ? partOf(towards, determinant) : middle;
  // Each for the other, once more: of segments that are almost parallel the determinant knows little.
  precise real reached = both * nearest.u + f;
  precise real first = partOf(reached, otherSquared);
  precise real back = both * first - c;
  nearest.u = partOf(back, alongSquared);
  precise real reachedAgain = both * nearest.u + f;
  nearest.v = partOf(reachedAgain, otherSquared);
  bool isInside = zero < nearest.u && nearest.u < one && zero < nearest.v && nearest.v < one;
  nearest.part = isInside ? NEAREST_FACE : NEAREST_CORNER;
  precise vec3 way = between + (nearest.u * along - nearest.v * other);
  nearest.way = way;
  return nearest;
}

// Whether a corner or side, from which `way` leads to something near, is still the nearest part where the
// surface goes on from it `outward`. A little aslant (3.6 degrees) counts, too: then each triangle there
// finds its share of the contact. Layers that slide over each other meet what is aslant as bumps; where cloth
// is wrung, with less than that too few pairs hold it.
LAW bool isStillNearest(vec3 way, vec3 outward) {
  const real slanted = real(0.00390625);  // the square of a cosine
  real rise = sumOfProducts(way, outward);
  precise real risen = rise * rise;
  precise real most = slanted * (sumOfProducts(way, way) * sumOfProducts(outward, outward));
  return rise <= real(0.0) || risen <= most;
}

// What a pair keeps of its distance in a step.
LAW real leastOf(real distance, real leastGap) {
  precise real most = real(0.9375) * distance;
  return leastGap < most ? leastGap : most;
}

// How much of its distance a pair that is cut short may lose in a step: 7/8 of it, but 1/16 at most of what
// is below the least gap.
LAW real budgetOf(real distance, real leastGap) {
  precise real most = real(0.875) * distance;
  precise real above = distance - leastGap;
  precise real little = real(0.0625) * distance;
  real budget = above < most ? above : most;
  return budget < little ? little : budget;
}

// Corner 0 and the triangle of the others, or two sides.
LAW NearestParts nearestParts(bool areSides, vec3 p, vec3 q, vec3 a, vec3 b) {
  if (areSides) return nearestOnSegments(p, q, a, b);
  return nearestOnTriangle(p, q, a, b);
}

// Whether the volume between both parts keeps its sign while they move from x to y, so that they are never in
// one plane: it is cubic in time, with the coefficients of Bernstein.
LAW bool staysBeside(bool areSides, vec3 x[4], vec3 y[4]) {
  const real zero = real(0.0), part = real(0.375);
  int from = areSides ? 0 : 1, to = areSides ? 1 : 2, base = areSides ? 2 : 1;
  precise vec3 u = x[to] - x[from];
  precise vec3 v = x[3] - x[base];
  precise vec3 w = x[0] - x[base];
  precise vec3 laterU = y[to] - y[from];
  precise vec3 laterV = y[3] - y[base];
  precise vec3 laterW = y[0] - y[base];
  vec3 first = crossProduct(u, v), last = crossProduct(laterU, laterV);
  precise vec3 middle = crossProduct(laterU, v) + crossProduct(u, laterV);
  precise real start = sumOfProducts(first, w);
  precise real early = sumOfProducts(middle, w) + sumOfProducts(first, laterW);
  precise real late = sumOfProducts(middle, laterW) + sumOfProducts(last, w);
  precise real end = sumOfProducts(last, laterW);
  precise real least = part * (start < end ? start : end);
  precise real most = part * (start < end ? end : start);
  return (zero < least && least < early && least < late) || (most < zero && early < most && late < most);
}

// Whether a plane separates them by more than `slack` that turns from across n to across m: what is between
// two corners is quadratic in time.
LAW bool staysAcross(bool areSides, vec3 x[4], vec3 y[4], vec3 n, vec3 m, real slack) {
  const real middling = real(0.5), little = real(0.25);
  int firsts = areSides ? 2 : 1;
  precise real between = little * slack;
  for (int i = 0; i < firsts; ++i)
    for (int j = firsts; j < 4; ++j) {
      precise vec3 before = x[i] - x[j];
      precise vec3 after = y[i] - y[j];
      precise real middle = middling * (sumOfProducts(before, m) + sumOfProducts(after, n));
      if (!(slack < sumOfProducts(before, n)) || !(between < middle) || !(slack < sumOfProducts(after, m)))
        return false;
    }
  return true;
}

// Whether one of both shows, for each of `count` parts of the time, that they stay apart.
LAW bool staysApart(bool areSides, vec3 x[4], vec3 y[4], vec3 way, real slack, int count) {
  precise vec3 n = inverseSquareRoot(sumOfProducts(way, way)) * way;
  vec3 before[4], after[4];
  for (int i = 0; i < 4; ++i) before[i] = x[i];
  for (int k = 1; k <= count; ++k) {
    precise real time = real(k) * reciprocal(real(count));
    for (int i = 0; i < 4; ++i) {
      precise vec3 moved = x[i] + time * (y[i] - x[i]);
      after[i] = k == count ? y[i] : moved;
    }
    NearestParts nearest = nearestParts(areSides, after[0], after[1], after[2], after[3]);
    precise vec3 m = inverseSquareRoot(sumOfProducts(nearest.way, nearest.way)) * nearest.way;
    if (!(slack < sumOfProducts(nearest.way, m))) return false;
    if (!staysBeside(areSides, before, after) && !staysAcross(areSides, before, after, n, m, slack))
      return false;
    for (int i = 0; i < 4; ++i) before[i] = after[i];
    n = m;
  }
  return true;
}

// Whether the way between two parts turns by less than 60 degrees.
LAW bool turnsLittle(vec3 way, vec3 wayAfter) {
  const real quarter = real(0.25);
  real before = sumOfProducts(way, way), after = sumOfProducts(wayAfter, wayAfter),
       both = sumOfProducts(way, wayAfter);
  precise real squared = both * both;
  precise real turned = quarter * (before * after);
  return real(0.0) < both && turned < squared;
}

// Whether parts that move from x to y surely come there without passing through each other: their way to each
// other turns by less than 60 degrees and keeps half of its length, or they stay apart by more than `slack`.
LAW bool passesBy(bool areSides, vec3 x[4], vec3 y[4], vec3 way, vec3 wayAfter, real slack) {
  const real quarter = real(0.25);
  precise real shortest = quarter * sumOfProducts(way, way);
  if (turnsLittle(way, wayAfter) && shortest < sumOfProducts(wayAfter, wayAfter)) return true;
  return staysApart(areSides, x, y, way, slack, FINE_PARTS);
}

// The least and the most of n.v for all v in a box.
LAW real lowestIn(vec3 n, vec3 low, vec3 high) {
  const real zero = real(0.0);
  precise real x = n.x * (n.x < zero ? high.x : low.x);
  precise real y = n.y * (n.y < zero ? high.y : low.y);
  precise real z = n.z * (n.z < zero ? high.z : low.z);
  precise real sum = (x + y) + z;
  return sum;
}
LAW real highestIn(vec3 n, vec3 low, vec3 high) {
  precise vec3 turned = vec3(real(0.0), real(0.0), real(0.0)) - n;
  precise real most = real(0.0) - lowestIn(turned, low, high);
  return most;
}

// A rectangle of a grid, all of whose sides along rows, over their distance in the grid, are in one box, and
// those along columns in another one: no two of its places are nearer than this many times their distance in
// the grid (negative: this is not known). For with directions p and q that are perpendicular, the gradient F
// of each triangle, which its two sides are, has (p q)^T F of a symmetric part whose eigenvalues are at least
// this (Gershgorin 1931), and so has its mean along the straight line between both places, which is all in
// the rectangle. While all moves linearly, F stays between its start and its end.
LAW real leastStretch(vec3 alongLow, vec3 alongHigh, vec3 downLow, vec3 downHigh) {
  precise vec3 along = alongLow + alongHigh;
  precise vec3 p = inverseSquareRoot(sumOfProducts(along, along)) * along;
  precise vec3 down = downLow + downHigh;
  precise vec3 across = down - sumOfProducts(p, down) * p;
  precise vec3 q = inverseSquareRoot(sumOfProducts(across, across)) * across;
  real first = lowestIn(p, alongLow, alongHigh), second = lowestIn(q, downLow, downHigh);
  precise real lowShear = lowestIn(p, downLow, downHigh) + lowestIn(q, alongLow, alongHigh);
  precise real highShear = highestIn(p, downLow, downHigh) + highestIn(q, alongLow, alongHigh);
  precise real turned = real(0.0) - lowShear;
  real shear = turned < highShear ? highShear : turned;
  precise real stretch = (first < second ? first : second) - real(0.5) * shear;
  return stretch;
}
