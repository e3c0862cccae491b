// Where a triangle meets the core of a small collider (SmallCollider). Written once, in the words that GLSL
// and C++ share (src/solver/cpu/surface_laws.h), in the own frame of the collider at the end of the step.

LAW real keptBetween(real low, real x, real high) { return x < low ? low : high < x ? high : x; }

LAW vec3 nearestOnCore(SmallCollider core, vec3 place) {
  const real zero = real(0.0);
  vec3 p = canonical(place);
  real y = keptBetween(zero - core.coreY, p.y, core.coreY);
  if (!(zero < core.outerRadius))
    return vec3(keptBetween(zero - core.coreX, p.x, core.coreX), y,
                keptBetween(zero - core.coreZ, p.z, core.coreZ));
  precise real axisSquared = p.x * p.x + p.z * p.z;
  precise real inverseAxis = inverseSquareRoot(axisSquared);
  precise real fromAxis = axisSquared * inverseAxis;
  precise real kept = keptBetween(core.coreX, fromAxis, core.outerRadius) * inverseAxis;
  precise real x = kept * p.x;
  precise real z = kept * p.z;
  return vec3(x, y, z);
}

LAW bool isPoint(SmallCollider core) {
  const real zero = real(0.0);
  return !(zero < core.coreX || zero < core.coreY || zero < core.coreZ || zero < core.outerRadius);
}

// The nearest places of a triangle and of the core: by projecting from one on the other and back, which for a
// point as core is done at once.
LAW NearestParts nearestToCore(SmallCollider core, vec3 a, vec3 b, vec3 c) {
  const real third = real(0.3333333432674407958984375);
  precise vec3 middle = third * ((a + b) + c);
  vec3 onCore = nearestOnCore(core, middle);
  NearestParts nearest = nearestOnTriangle(onCore, a, b, c);
  if (isPoint(core)) return nearest;
  for (int i = 0; i < CORE_ROUNDS; ++i) {
    precise vec3 place = onCore - nearest.way;
    onCore = nearestOnCore(core, place);
    nearest = nearestOnTriangle(onCore, a, b, c);
  }
  return nearest;
}

// On which side of a triangle a point is.
LAW bool isAboveTriangle(vec3 p, vec3 a, vec3 b, vec3 c) {
  precise vec3 ab = b - a;
  precise vec3 ac = c - a;
  precise vec3 ap = p - a;
  real volume = sumOfProducts(crossProduct(ab, ac), ap);
  return real(0.0) < volume;
}

// Where a triangle that moves from `from` to `to` meets the core: where it is when the core passes through it
// or near it, else where it is nearest at the end.
struct Meeting {
  real u;
  real v;
  uint part;
  bool isOnWay;  // the core passes the triangle or comes near it
  bool passes;   // the core goes through the triangle
  real pierced;  // how far a tip is through it [m]; 0: none is
};
LAW Meeting meetingAt(real u, real v, uint part) {
  Meeting meeting;
  meeting.u = u;
  meeting.v = v;
  meeting.part = part;
  meeting.isOnWay = false;
  meeting.passes = false;
  meeting.pierced = real(0.0);
  return meeting;
}
LAW Meeting meetingOf(SmallCollider core, vec3 from[3], vec3 to[3]) {
  const real middle = real(0.5), slight = real(0.0625);
  NearestParts nearest = nearestToCore(core, to[0], to[1], to[2]);
  Meeting meeting = meetingAt(nearest.u, nearest.v, nearest.part);
  vec3 x[3];
  for (int k = 0; k < 3; ++k) x[k] = to[k];
  precise real radiusSquared = core.radius * core.radius;
  precise real slightSquared = slight * radiusSquared;
  for (int round = 0; round < 2; ++round) {
    precise vec3 place = (x[0] + nearest.u * (x[1] - x[0])) + nearest.v * (x[2] - x[0]);
    precise vec3 onCore = place + nearest.way;
    bool isAbove = isAboveTriangle(onCore, from[0], from[1], from[2]);
    if (isAbove == isAboveTriangle(onCore, to[0], to[1], to[2])) return meeting;
    precise real before = real(0.0);
    precise real after = real(1.0);
    for (int i = 0; i < CROSSING_ROUNDS; ++i) {
      precise real time = middle * (before + after);
      for (int k = 0; k < 3; ++k) {
        precise vec3 moved = from[k] + time * (to[k] - from[k]);
        x[k] = moved;
      }
      bool isBefore = isAboveTriangle(onCore, x[0], x[1], x[2]) == isAbove;
      before = isBefore ? time : before;
      after = isBefore ? after : time;
    }
    nearest = nearestToCore(core, x[0], x[1], x[2]);
    precise real waySquared = sumOfProducts(nearest.way, nearest.way);
    if (radiusSquared < waySquared) return meeting;
    meeting.u = nearest.u;
    meeting.v = nearest.v;
    meeting.part = nearest.part;
    meeting.isOnWay = true;
    meeting.passes = waySquared < slightSquared;
  }
  return meeting;
}
