// Where triangles meet shapes that are known by their signed distance. Written once, in the words that GLSL
// and C++ share (src/solver/cpu/small_colliders.cpp), in the own frame of the collider at the end of the
// step. After shared/core_laws.h and shared/shapes.h.

// The place of a triangle that is deepest in a shape, or nearest to it: M. Macklin, K. Erleben, M. Müller,
// N. Chentanez, S. Jeschke and Z. Corse, "Local optimization for robust signed distance field collision",
// 2020 (the method of Frank and Wolfe). It begins where the core is nearest. Each round goes towards the
// corner that is deepest behind the tangent plane, for as long as the distance falls. At an edge of the shape
// the place ends on that edge and stays there.
LAW Meeting deepestPlace(ColliderParams shape, SmallCollider core, vec3 corners[3]) {
  const real zero = real(0.0), one = real(1.0), middle = real(0.5);
  NearestParts nearest = nearestToCore(core, corners[0], corners[1], corners[2]);
  precise vec3 first =
      (corners[0] + nearest.u * (corners[1] - corners[0])) + nearest.v * (corners[2] - corners[0]);
  vec3 place = first;
  Meeting meeting = meetingAt(nearest.u, nearest.v, nearest.part);
  for (int round = 0; round < DEEPEST_ROUNDS; ++round) {
    vec3 normal = nearestOnShape(shape, canonical(place)).normal;
    int goal = 0;
    real least = sumOfProducts(normal, corners[0]);
    for (int k = 1; k < 3; ++k) {
      real height = sumOfProducts(normal, corners[k]);
      goal = height < least ? k : goal;
      least = height < least ? height : least;
    }
    precise vec3 way = corners[goal] - place;
    real before = zero, after = one;
    for (int i = 0; i < DEEPEST_HALVINGS; ++i) {
      precise real part = middle * (before + after);
      precise vec3 there = place + part * way;
      bool falls = sumOfProducts(nearestOnShape(shape, canonical(there)).normal, way) < zero;
      before = falls ? part : before;
      after = falls ? after : part;
    }
    real goalU = goal == 1 ? one : zero, goalV = goal == 2 ? one : zero;
    if (!(after < one)) {
      place = corners[goal];
      meeting.u = goalU;
      meeting.v = goalV;
      meeting.part = NEAREST_CORNER + uint(goal);
      continue;
    }
    precise vec3 next = place + before * way;
    precise real u = meeting.u + before * (goalU - meeting.u);
    precise real v = meeting.v + before * (goalV - meeting.v);
    place = next;
    meeting.u = u;
    meeting.v = v;
    if (zero < before) meeting.part = NEAREST_FACE;
  }
  return meeting;
}

// The corner or rim of a box, cylinder or cone that is farthest along n.
struct Tip {
  vec3 place;
  real width;  // the radius of the rim [m]
};
LAW Tip farthestTip(ColliderParams shape, vec3 n) {
  const real zero = real(0.0);
  Tip tip;
  tip.width = zero;
  real up = n.y < zero ? -shape.sizeY : shape.sizeY;
  if (shape.type == COLLIDER_BOX) {
    precise vec3 corner =
        vec3(n.x < zero ? -shape.sizeX : shape.sizeX, up, n.z < zero ? -shape.sizeZ : shape.sizeZ) +
        shape.radius * n;
    tip.place = corner;
    return tip;
  }
  vec3 across = canonical(vec3(n.x, zero, n.z));
  real acrossSquared = sumOfProducts(across, across);
  tip.width = shape.radius;
  if (shape.type == COLLIDER_CONE) {
    precise real reach = inverseSquareRoot(acrossSquared) * acrossSquared;
    precise real lower = shape.sizeX * reach - shape.sizeY * n.y;
    precise real upper = shape.sizeZ * reach + shape.sizeY * n.y;
    tip.width = lower < upper ? shape.sizeZ : shape.sizeX;
    up = lower < upper ? shape.sizeY : -shape.sizeY;
  }
  precise vec3 rim = (tip.width * inverseSquareRoot(acrossSquared)) * across;
  tip.place = vec3(rim.x, up, rim.z);
  return tip;
}

// The unit normal of a triangle at the end, away from where the core was at its start.
LAW vec3 awayFromCore(vec3 inner, vec3 from[3], vec3 to[3]) {
  const real zero = real(0.0);
  precise vec3 ab = to[1] - to[0];
  precise vec3 ac = to[2] - to[0];
  vec3 across = canonical(crossProduct(ab, ac));
  precise vec3 own = inverseSquareRoot(sumOfProducts(across, across)) * across;
  precise vec3 turned = vec3(zero, zero, zero) - own;
  return isAboveTriangle(inner, from[0], from[1], from[2]) ? turned : own;
}

// Where a triangle that moves from `from` to `to` meets such a shape: at the tip that goes through it; else
// where the core passes it or comes near; else where it is deepest at the end. At an edge that search does
// not come to rest from one Newton step to the next: `keeps` says to stay at the place (u, v) there.
LAW Meeting meetingWithShape(ColliderParams shape, SmallCollider core, vec3 from[3], vec3 to[3], bool keeps,
                             real u, real v) {
  const real zero = real(0.0), quarter = real(0.25), eighth = real(0.125),
             third = real(0.3333333432674407958984375);
  precise vec3 middle = third * ((from[0] + from[1]) + from[2]);
  vec3 inner = nearestOnCore(core, middle);
  vec3 normal = awayFromCore(inner, from, to);
  Tip tip = farthestTip(shape, normal);
  NearestParts below = nearestOnTriangle(tip.place, to[0], to[1], to[2]);
  real height = sumOfProducts(below.way, normal);
  precise real heightSquared = height * height;
  precise real aside = quarter * sumOfProducts(below.way, below.way);
  bool isCorner = below.part != NEAREST_FACE && below.part < NEAREST_SIDE;
  // A tip that has gone through beside a corner of the triangle is nearest to that corner for all triangles
  // around it. It went through the one that lies between the tip and the other end of the core.
  if (isCorner && zero < height) {
    vec3 otherEnd =
        vec3(tip.place.x < zero ? core.coreX : -core.coreX, tip.place.y < zero ? core.coreY : -core.coreY,
             tip.place.z < zero ? core.coreZ : -core.coreZ);
    precise vec3 back = otherEnd - tip.place;
    precise real fall = zero - sumOfProducts(back, normal);
    precise vec3 crossing = tip.place + partOf(height, fall) * back;
    below = nearestOnTriangle(crossing, to[0], to[1], to[2]);
    precise real off = real(64.0) * sumOfProducts(below.way, below.way);
    isCorner = !(off < heightSquared);
    aside = zero;
  }
  // It was not through before, or hardly.
  precise vec3 towardsTip = tip.place - from[0];
  real heightBefore = sumOfProducts(towardsTip, awayFromCore(inner, from, from));
  precise real reach = core.near - core.radius;
  precise real hardly = eighth * reach;
  bool isTip = !isCorner && zero < height && heightBefore < hardly && aside < heightSquared;
  // A wide rim is an edge, of which no place is farther along the normal than others for long.
  precise real wide = quarter * reach;
  bool isNarrow = shape.type != COLLIDER_TORUS && tip.width < wide;
  isTip = isTip && isNarrow;
  Meeting meeting = meetingAt(zero, zero, NEAREST_CORNER);
  if (!(core.outerRadius < zero)) meeting = meetingOf(core, from, to);
  if (isTip) {
    meeting.u = below.u;
    meeting.v = below.v;
    meeting.part = below.part;
    meeting.pierced = height;
  } else if (!meeting.isOnWay && keeps && (shape.type == COLLIDER_BOX || !isNarrow)) {
    meeting = meetingAt(u, v, NEAREST_FACE);
  } else if (!meeting.isOnWay) {
    meeting = deepestPlace(shape, core, to);
  }
  return meeting;
}

// The way out for a triangle that an edge or a tip of the shape presses into: along the triangle's own
// normal, since that of the shape turns there from one of its faces to the other.
struct WayOut {
  bool counts;  // false: there is no such way, and the shape's own normal is as good
  vec3 normal;  // away from the core
  real depth;   // [m]
};
LAW WayOut wayOutOf(ColliderParams shape, SmallCollider core, vec3 from[3], vec3 to[3], Meeting meeting) {
  const real zero = real(0.0), middle = real(0.5), quarter = real(0.25);
  WayOut way;
  way.counts = false;
  way.depth = zero;
  precise vec3 start = (from[0] + meeting.u * (from[1] - from[0])) + meeting.v * (from[2] - from[0]);
  precise vec3 place = (to[0] + meeting.u * (to[1] - to[0])) + meeting.v * (to[2] - to[0]);
  vec3 inner = nearestOnCore(core, start);
  vec3 normal = awayFromCore(inner, from, to);
  way.normal = normal;
  if (zero < meeting.pierced) {
    way.counts = true;
    way.depth = meeting.pierced;
    return way;
  }
  // The core lies behind the triangle rather than beside it.
  precise vec3 fromCore = canonical(start - inner);
  real outward = sumOfProducts(fromCore, normal);
  precise real outwardSquared = outward * outward;
  precise real least = quarter * sumOfProducts(fromCore, fromCore);
  if (!(zero < outward) || !(least < outwardSquared)) return way;
  real facing = sumOfProducts(nearestOnShape(shape, canonical(place)).normal, normal);
  if (!(quarter < facing)) return way;
  precise vec3 toCore = nearestOnCore(core, place) - place;
  real level = sumOfProducts(toCore, normal);
  real before = zero < level ? level : zero;
  precise real after = before + core.near;
  precise vec3 inside = place + before * normal;
  if (!(nearestOnShape(shape, canonical(inside)).distance < zero)) return way;
  for (int i = 0; i < CROSSING_ROUNDS; ++i) {
    precise real depth = middle * (before + after);
    precise vec3 there = place + depth * normal;
    bool isInside = nearestOnShape(shape, canonical(there)).distance < zero;
    before = isInside ? depth : before;
    after = isInside ? after : depth;
  }
  way.counts = true;
  way.depth = after;
  return way;
}
