// A round of the guard, an invocation a triangle: pairs that the motion so far brings too near are pushed apart, or keep to
// their own sides, in the last round all pairs. That may bring others too near: they are seen in the next round. The last work
// group to finish moves the particles that are to be moved, or takes over what they keep of their motion.
#include "shared/surface.h"

layout(std140, binding = GUARD_ROUND_BINDING) uniform RoundBlock { GuardRound round; };
#define HOLDS_BACK (round.number > uint(CORRECTION_ROUNDS))
#include "sim/surface/common.glsl"
#define GROUPS_DONE state.groupsDone
#include "sim/last_group.glsl"

layout(local_size_x = SURFACE_GROUP) in;
// What each particle keeps of its motion, bits of floats; then the same with what this round takes.
layout(std430, binding = SURFACE_COUNTS_BINDING) coherent buffer Kept { uint kept[]; };
layout(std430, binding = SURFACE_LISTS_BINDING) coherent buffer Corrections { int corrections[]; };
layout(std430, binding = SURFACE_MOVED_BINDING) coherent buffer Moved { uint moved[]; };  // particles, in any order
layout(std430, binding = NEW_POSITIONS_BINDING) buffer NewPositions { vec4 newPositions[]; };
layout(std430, binding = NEW_VELOCITIES_BINDING) buffer NewVelocities { vec4 newVelocities[]; };

bool corrects() { return round.number < uint(CORRECTION_ROUNDS); }
void noteMoved(uint i) { moved[atomicAdd(state.moved, 1u)] = i; }

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
  float last = greater(p.z, p.w);
  return areSides ? last : greater(p.y, last);
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
  precise float slack = uintBitsToFloat(0x3f733333u) * least;  // KEPT_GAP
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
      firstMotion = greater(firstMotion, -sides.motions[k]);
    else
      secondMotion = greater(secondMotion, sides.motions[k]);
  }
  float width = widthOf(sides), budget = budgetOf(greater(width, 0.0), surface.leastGap);
  precise float both = firstMotion + secondMotion;
  precise float share = budget * (firstMotion * reciprocal(greater(both, LEAST_APPROACH)));
  for (int k = 0; k < 4; ++k) {
    bool isFirst = k < firsts;
    float towards = isFirst ? -sides.motions[k] : sides.motions[k];
    precise float firstRoom = share + (sides.places[k] - sides.first);
    precise float secondRoom = (budget - share) + (sides.second - sides.places[k]);
    float room = isFirst ? firstRoom : secondRoom;
    precise float part = room * reciprocal(greater(towards, LEAST_APPROACH));
    if (!(width > 0.0))
      part = 0.0;
    else if (!(room < towards) || !(towards > LEAST_APPROACH))
      continue;
    uint i = sides.ids[k], bits = floatBitsToUint(canonical(part));
    uint before = atomicMin(kept[step.totalParticles + i], bits);
    if (bits < before && before == kept[i]) noteMoved(i);  // the first time in this round
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
  precise float slack = uintBitsToFloat(0x3f733333u) * least;  // KEPT_GAP
  bool apart = false;
  for (int turn = 0; turn < 2 && !apart; ++turn) apart = staysApart(areSides, x, y, way, slack, turn == 0 ? 1 : FINE_PARTS);
  return !apart;
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
  precise float push = surface.perQuantum * (missing < surface.largestPush ? missing : surface.largestPush);
  for (int k = 0; k < 4; ++k) {
    precise float whole = (weights[k] * inverses[k]) * reciprocal(mobility);
    precise float part = push * (whole < -1.0 ? -1.0 : 1.0 < whole ? 1.0 : whole);
    precise vec3 move = part * normal;
    precise float counts = float(CORRECTION_WEIGHT) * (weights[k] < 0.0 ? -weights[k] : weights[k]);
    uint place = 4u * ids[k];
    atomicAdd(corrections[place], int(move.x));
    atomicAdd(corrections[place + 1u], int(move.y));
    atomicAdd(corrections[place + 2u], int(move.z));
    if (int(counts) != 0 && atomicAdd(corrections[place + 3u], int(counts)) == 0) noteMoved(ids[k]);
  }
}

void lookAt(uvec4 ids, bool areSides, PartPlaces places, NearestParts nearest) {
  Sides sides = sidesOf(ids, areSides, nearest.way);
  bool takesAll = round.number + 1u == uint(GUARD_ROUNDS);
  float width = greater(widthOf(sides), 0.0);
  float least = corrects() ? surface.leastGap : leastOf(width, surface.leastGap);
  if (!takesAll && !isTooNear(sides, least)) return;
  Sides sliding = sidesOf(ids, areSides, acrossBoth(ids, areSides, nearest.way));
  if (!takesAll && !isTooNear(sliding, least)) return;
  if (!takesAll && !turnsTooNear(ids, areSides, nearest.way, least)) return;
  state.tooNear[round.number] = 1u;
  if (corrects()) {
    pushApart(ids, areSides, nearest.way, least);
    return;
  }
  precise float enough = 0.5 * width;
  if (widthOf(sliding) > enough) sides = sliding;
  keepToSides(sides);
}
bool goesOn() { return true; }
// Whatever the first rounds move, the first of the others looks at everything again.
bool looksAtFlat() { return !corrects(); }
#include "sim/surface/walk.glsl"

// In two halves, each of which converts exactly.
float fromQuanta(int sum) {
  precise float value = float(sum >> 12) * 4096.0 + float(sum & 4095);
  return value;
}

// What the pairs that are too near want of a particle: the mean of it, where they want more than all.
void correct(uint i) {
  ivec4 sum = ivec4(corrections[4u * i], corrections[4u * i + 1u], corrections[4u * i + 2u], corrections[4u * i + 3u]);
  vec4 place = newPositions[i];
  if (!(place.w > 0.0)) return;
  float weight = reciprocal(float(sum.w < CORRECTION_WEIGHT ? CORRECTION_WEIGHT : sum.w));
  precise float part = (surface.quantum * float(CORRECTION_WEIGHT)) * weight;
  precise vec3 motion = part * vec3(fromQuanta(sum.x), fromQuanta(sum.y), fromQuanta(sum.z));
  precise vec3 end = place.xyz + motion;
  precise vec3 velocity = newVelocities[i].xyz + step.inverseTimeStep * motion;
  float squared = sumOfProducts(motion, motion);
  precise float far = squared * inverseSquareRoot(squared);
  atomicMax(state.largestCorrection, floatBitsToUint(canonical(far)));
  if (far > FAR_PUSH * surface.largestPush) state.wasPushedFar = 1u;
  newPositions[i] = vec4(canonical(end), place.w);
  newVelocities[i] = vec4(canonical(velocity), 0.0);
  for (uint k = 4u * i; k < 4u * i + 4u; ++k) corrections[k] = 0;
}

void main() {
  if (isSettled() || state.tooMany == 2u) return;
  // What was pushed apart may be too near to what no round has seen so far.
  uint deciding = round.number == uint(CORRECTION_ROUNDS) ? 0u : round.number - 1u;
  if (round.number > 0u && state.tooNear[deciding] == 0u) return;
  uint own = thisEntry();
  if (own < surface.triangles && (looksAtFlat() || state.isFlat == 0u)) lookAround(own);
  if (!isLastGroupOf(gl_NumWorkGroups.x * gl_NumWorkGroups.y)) return;
  for (uint k = gl_LocalInvocationIndex; k < state.moved; k += uint(SURFACE_GROUP)) {
    uint i = moved[k];
    if (corrects())
      correct(i);
    else
      kept[i] = kept[step.totalParticles + i];
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u) state.moved = 0u;
}
