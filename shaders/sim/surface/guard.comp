// A round of the guard, an invocation a triangle: pairs that the motion so far brings too near are pushed apart, or keep to
// their own sides, in the last round all pairs. That may bring others too near: they are seen in the next round.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std140, binding = BOX_LEVEL_BINDING) uniform RoundBlock { BoxLevel round; };
layout(std430, binding = SURFACE_COUNTS_BINDING) readonly buffer Kept { uint kept[]; };               // bits of floats
layout(std430, binding = SURFACE_LISTS_BINDING) coherent buffer NewlyKept { uint newlyKept[]; };
layout(std430, binding = SURFACE_OUT_BINDING) coherent buffer Corrections { int corrections[]; };

float larger(float a, float b) { return a < b ? b : a; }

// Two parts across the way on which they are nearest: where their particles are along it, from the first one on, and how far
// they move.
struct Sides {
  bool areSides;
  uvec4 ids;
  vec4 places, motions;
  float first, second;  // the places of each part that are nearest to the other
};

float nearestOfFirst(bool areSides, vec4 p) { return areSides && p.y < p.x ? p.y : p.x; }
float nearestOfSecond(bool areSides, vec4 p) {
  float last = larger(p.z, p.w);
  return areSides ? last : larger(p.y, last);
}

Sides sidesOf(uvec4 ids, bool areSides, vec3 way) {
  Sides sides;
  sides.ids = ids;
  sides.areSides = areSides;
  precise vec3 normal = inverseSquareRoot(sumOfProducts(way, way)) * way;
  vec3 origin = startAt(ids.x);
  for (int k = 0; k < 4; ++k) {
    precise vec3 from = startAt(ids[k]) - origin;
    sides.places[k] = sumOfProducts(normal, from);
    sides.motions[k] = sumOfProducts(normal, motionAt(ids[k]));
  }
  sides.first = nearestOfFirst(areSides, sides.places);
  sides.second = nearestOfSecond(areSides, sides.places);
  return sides;
}
float widthOf(Sides sides) {
  precise float width = sides.first - sides.second;
  return width;
}

// Whether the motion so far leaves less than `least` between the parts. All moves linearly, so that no less is left on the way
// than at its ends.
bool isTooNear(Sides sides, float least) {
  vec4 p;
  for (int k = 0; k < 4; ++k) {
    precise float place = sides.places[k] + uintBitsToFloat(kept[sides.ids[k]]) * sides.motions[k];
    p[k] = place;
  }
  precise float left = nearestOfFirst(sides.areSides, p) - nearestOfSecond(sides.areSides, p);
  precise float slack = uintBitsToFloat(0x3f733333u) * least;  // .95
  return !(left > slack) || !(widthOf(sides) > slack);
}

// Across the triangle, or both sides: parts that slide over each other keep their distance that way.
vec3 acrossOf(vec3 i, vec3 j, vec3 k, vec3 l, bool areSides, vec3 way) {
  precise vec3 along = areSides ? j - i : k - j;
  precise vec3 other = areSides ? l - k : l - j;
  vec3 normal = crossProduct(along, other);
  precise vec3 turned = vec3(0.0) - normal;
  return sumOfProducts(normal, way) < 0.0 ? turned : normal;
}
vec3 acrossBoth(uvec4 ids, bool areSides, vec3 way) {
  return acrossOf(startAt(ids.x), startAt(ids.y), startAt(ids.z), startAt(ids.w), areSides, way);
}

// Cuts the motions of all four particles short, so that both parts keep to their shares of the budget, by their speeds. Parts
// that no plane across the way separates, as far as binary32 knows, do not move.
void keepToSides(Sides sides) {
  int firsts = sides.areSides ? 2 : 1;
  float firstMotion = 0.0, secondMotion = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (k < firsts)
      firstMotion = larger(firstMotion, -sides.motions[k]);
    else
      secondMotion = larger(secondMotion, sides.motions[k]);
  }
  float width = widthOf(sides), budget = budgetOf(larger(width, 0.0), surface.leastGap);
  precise float both = firstMotion + secondMotion;
  precise float share = budget * (firstMotion * reciprocal(larger(both, LEAST_APPROACH)));
  for (int k = 0; k < 4; ++k) {
    bool isFirst = k < firsts;
    float towards = isFirst ? -sides.motions[k] : sides.motions[k];
    precise float firstRoom = share + (sides.places[k] - sides.first);
    precise float secondRoom = (budget - share) + (sides.second - sides.places[k]);
    float room = isFirst ? firstRoom : secondRoom;
    precise float part = room * reciprocal(larger(towards, LEAST_APPROACH));
    if (!(width > 0.0))
      part = 0.0;
    else if (!(room < towards) || !(towards > LEAST_APPROACH))
      continue;
    atomicMin(newlyKept[sides.ids[k]], floatBitsToUint(canonical(part)));
  }
}

// The same across planes that turn along with the parts.
bool turnsTooNear(uvec4 ids, bool areSides, vec3 way, float least) {
  vec3 x[4], y[4];
  for (int k = 0; k < 4; ++k) {
    x[k] = startAt(ids[k]);
    precise vec3 place = x[k] + uintBitsToFloat(kept[ids[k]]) * motionAt(ids[k]);
    y[k] = place;
  }
  precise float slack = uintBitsToFloat(0x3f733333u) * least;  // .95
  return !staysApart(areSides, x, y, way, slack, 1) && !staysApart(areSides, x, y, way, slack, FINE_PARTS);
}

vec3 endAt(uint i) { return texelFetch(positionsSoFar, int(i)).xyz; }

// Where the pair is nearest at the end, across the parts as they are then: all four go apart, by their weights and masses,
// until a little more than the least distance is left.
void pushApart(uvec4 ids, bool areSides, vec3 way, float least) {
  vec3 p = endAt(ids.x), a = endAt(ids.y), b = endAt(ids.z), c = endAt(ids.w);
  NearestParts nearest = nearestParts(areSides, p, a, b, c);
  vec3 across = acrossOf(p, a, b, c, areSides, way);
  float along = sumOfProducts(across, way);
  precise float squared = sumOfProducts(across, across) * sumOfProducts(way, way);
  precise float quarter = 0.25 * squared;
  precise float alongSquared = along * along;
  vec3 towards = quarter < alongSquared ? across : way;
  precise vec3 normal = inverseSquareRoot(sumOfProducts(towards, towards)) * towards;
  vec4 weights = weightsOf(areSides, nearest), inverses;
  precise float mobility = 0.0;
  for (int k = 0; k < 4; ++k) {
    inverses[k] = texelFetch(surfaceStarts, int(ids[k])).w;
    mobility = mobility + (weights[k] * weights[k]) * inverses[k];
  }
  precise float missing = 2.0 * least - sumOfProducts(normal, nearest.way);
  if (!(missing > 0.0) || !(mobility > 0.0)) return;
  precise float push = surface.perQuantum * (missing < surface.margin ? missing : surface.margin);
  for (int k = 0; k < 4; ++k) {
    precise float whole = (weights[k] * inverses[k]) * reciprocal(mobility);
    precise float part = push * (whole < -1.0 ? -1.0 : 1.0 < whole ? 1.0 : whole);
    precise vec3 move = part * normal;
    precise float counts = float(CORRECTION_WEIGHT) * (weights[k] < 0.0 ? -weights[k] : weights[k]);
    uint place = 4u * ids[k];
    atomicAdd(corrections[place], int(move.x));
    atomicAdd(corrections[place + 1u], int(move.y));
    atomicAdd(corrections[place + 2u], int(move.z));
    atomicAdd(corrections[place + 3u], int(counts));
  }
}

void lookAt(uvec4 ids, bool areSides, PartPlaces places, NearestParts nearest) {
  Sides sides = sidesOf(ids, areSides, nearest.way);
  bool takesAll = round.first + 1u == uint(GUARD_ROUNDS);
  float width = larger(widthOf(sides), 0.0);
  bool corrects = round.first < uint(CORRECTION_ROUNDS);
  float least = corrects ? surface.leastGap : leastOf(width, surface.leastGap);
  if (!takesAll && !isTooNear(sides, least)) return;
  Sides sliding = sidesOf(ids, areSides, acrossBoth(ids, areSides, nearest.way));
  if (!takesAll && !isTooNear(sliding, least)) return;
  if (!takesAll && !turnsTooNear(ids, areSides, nearest.way, least)) return;
  state.tooNear[round.first] = 1u;
  if (corrects) {
    pushApart(ids, areSides, nearest.way, least);
    return;
  }
  precise float enough = 0.5 * width;
  if (widthOf(sliding) > enough)
    keepToSides(sliding);
  else
    keepToSides(sides);
}
bool goesOn() { return true; }
// Whatever the first rounds move, the first of the others looks at everything again.
bool looksAtFlat() { return round.first >= uint(CORRECTION_ROUNDS); }
#include "sim/surface/walk.glsl"

void main() {
  uint own = thisEntry();
  if (own >= surface.triangles || isSettled() || state.tooMany == 2u) return;
  // What was pushed apart may be too near to what no round has seen so far.
  if (round.first > 0u && state.tooNear[round.first == uint(CORRECTION_ROUNDS) ? 0u : round.first - 1u] == 0u) return;
  if (looksAtFlat() || state.isFlat == 0u) lookAround(own);
}
