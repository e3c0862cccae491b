// The pairs of parts that may touch, an invocation a triangle: first how many it finds, then, once it is known where they go,
// the pairs.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;

layout(std430, binding = SURFACE_COUNTS_BINDING) buffer Counts { uint counts[]; };
layout(binding = RIGHT_HAND_SIDES_UNIT) uniform samplerBuffer rightHandSides;
#if WRITES_PAIRS
#include "sim/implicit/scalars.glsl"
layout(std430, binding = SURFACE_LISTS_BINDING) coherent buffer ListCounts { uint listCounts[]; };
layout(binding = SURFACE_BLOCKS_UNIT) uniform usamplerBuffer blockStarts;
layout(std430, binding = SURFACE_IDS_BINDING) writeonly buffer Ids { uvec4 newIds[]; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Rows { vec4 newRows[]; };
layout(std430, binding = PAIR_SLIPS_BINDING) writeonly buffer Slips { uvec4 newSlips[]; };
#endif

layout(binding = ITERATES_UNIT) uniform samplerBuffer iterates;
layout(binding = SURFACE_RINGS_UNIT) uniform usamplerBuffer rings;

uint found = 0u, firstFound = 0u, firstPlace = 0u;
#if HAS_SMALL_COLLIDERS
#include "sim/surface/near.glsl"
#endif

bool isAtEnd = false;  // of the way that is predicted
vec3 endAt(uint i) { return texelFetch(iterates, int(i)).xyz; }
vec3 placeAt(uint i) { return isAtEnd ? endAt(i) : startAt(i); }

bool isNearest(uint outer, uint corner, uint particle, vec3 way) {
  precise vec3 outward = placeAt(outer) - placeAt(corner);
  return outer != particle && isStillNearest(way, outward);
}

// Whether a side is the nearest part of both triangles at it.
bool isNearestSide(uint triangle, uint k, vec3 way) {
  uvec4 corners = texelFetch(triangles, int(2u * triangle));
  uint across = texelFetch(triangles, int(2u * triangle + 1u))[k];
  return isNearest(corners[(k + 2u) % 3u], corners[k], NO_PARTICLE, way) &&
         (across == NO_PARTICLE || isNearest(across, corners[k], NO_PARTICLE, way));
}

// The part of a contact that a pair of parts finds.
float shareOf(uint particle, bool areSides, PartPlaces places, NearestParts nearest) {
  if (areSides) {
    precise vec3 back = vec3(0.0) - nearest.way;
    bool isContact = nearest.part == NEAREST_FACE && isNearestSide(places.second, places.l, nearest.way) &&
                     isNearestSide(places.first, places.k, back);
    return isContact ? 1.0 : 0.0;
  }
  if (nearest.part == NEAREST_FACE) return 1.0;
  uvec4 corners = texelFetch(triangles, int(2u * places.second)), across = texelFetch(triangles, int(2u * places.second + 1u));
  if (nearest.part >= NEAREST_SIDE) {
    uint k = nearest.part - NEAREST_SIDE;
    if (across[k] == NO_PARTICLE) return 1.0;
    return isNearest(across[k], corners[k], particle, nearest.way) ? 0.5 : 0.0;
  }
  uint corner = corners[nearest.part - NEAREST_CORNER], end = texelFetch(rings, int(corner + 1u)).x;
  for (uint k = texelFetch(rings, int(corner)).x; k < end; ++k)
    if (!isNearest(texelFetch(rings, int(k)).x, corner, particle, nearest.way)) return 0.0;
  return texelFetch(points, int(corner)).z;
}

// The pair as it is at the start or, `isMoved`, moved by the displacements. Not if it `mustTouch` and does not.
void addPair(uvec4 ids, bool areSides, PartPlaces places, NearestParts nearest, bool isMoved, bool mustTouch, float distanceBefore) {
  float squared = sumOfProducts(nearest.way, nearest.way), inverse = inverseSquareRoot(squared);
  precise float distance = squared * inverse;
  precise vec3 scaled = inverse * nearest.way;
  vec3 normal = canonical(scaled);
  vec4 weights = weightsOf(areSides, nearest);
  precise float reach = 0.0;
  precise float inertia = 0.0;
  precise float springs = 0.0;
  precise float squares = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec4 point = texelFetch(points, int(ids[k]));
    float w = weights[k], size = w < 0.0 ? -w : w;
    precise float square = w * w;
    reach = reach + size * point.x;
    inertia = inertia + square * texelFetch(rightHandSides, int(ids[k])).w;
    springs = springs + square * point.w;
    squares = squares + square;
  }
  precise vec3 moved = ((weights.x * displacementAt(ids.x) + weights.y * displacementAt(ids.y)) + weights.z * displacementAt(ids.z)) +
                       weights.w * displacementAt(ids.w);
  float along = sumOfProducts(normal, moved);
  precise float moving = distance + along;
  float predicted = isMoved ? distance : moving;
  precise float near = reach + surface.margin;
  if (!((predicted < distance ? predicted : distance) < near)) return;
  precise float squeezed = uintBitsToFloat(0x3ca3d70au) * reach;  // SQUEEZED
  float gap = distance < squeezed ? squeezed : distance;
  precise float halfReach = 0.5 * reach;
  precise float room = (4.0 * gap) * (reach - gap);
  precise float more = (reach * reach) * reciprocal(room);
  precise float stiffness = PAIR_OVER_INERTIA * (inertia * reciprocal(squares)) + springs;
  precise float stiffer = stiffness * more;
  precise float ofPair = shareOf(ids.x, areSides, places, nearest) * (gap < halfReach ? stiffer : stiffness);
  precise float nearer = reach - distance;
  precise float nearerBefore = nearer + along;
  float over = canonical(isMoved ? nearerBefore : nearer);
  precise float overThen = over - along;
  if (!(ofPair > 0.0) || (mustTouch && !(overThen > 0.0))) return;
  ++found;
#if WRITES_PAIRS
  uint q = firstFound + found - 1u;
  float held = overThen > 0.0 ? ofPair : 0.0;
  newIds[q] = ids;
  newRows[4u * q] = vec4(normal, over);
  newRows[4u * q + 1u] = weights;
  newRows[4u * q + 2u] = vec4(ofPair, LARGE_SQUARE, 0.0, held);
  newRows[4u * q + 3u] = vec4(0.0);
  newSlips[2u * q] = uvec4(uvec3(0u), firstPlace);
  for (int k = 0; k < 4; ++k) atomicAdd(listCounts[ids[k]], 1u);
  atomicMin(state.leastGap, floatBitsToUint(distanceBefore));
  if (held > 0.0) atomicOr(scalars.isDisturbed, 1u);
#endif
}

// Where the parts surely pass each other on the way that is predicted, the pair is as it will be at its end; or none, where they
// have left each other behind then.
void lookAt(uvec4 ids, bool areSides, PartPlaces places, NearestParts nearest) {
  float squared = sumOfProducts(nearest.way, nearest.way);
  precise float distance = squared * inverseSquareRoot(squared);
  isAtEnd = false;
  bool isMoved = state.isLater != 0u, mustTouch = false;
  NearestParts seen = nearest;
  if (!isMoved) {
    vec3 before[4], after[4];
    for (int k = 0; k < 4; ++k) {
      before[k] = startAt(ids[k]);
      after[k] = endAt(ids[k]);
    }
    NearestParts then = nearestParts(areSides, after[0], after[1], after[2], after[3]);
    isAtEnd = passesBy(areSides, before, after, nearest.way, then.way, surface.leastGap);
    isMoved = isAtEnd;
    if (isAtEnd) {
      seen = then;
      mustTouch = !turnsLittle(nearest.way, then.way);
    }
  }
  addPair(ids, areSides, places, seen, isMoved, mustTouch, distance);  // called once: drivers compile a copy for each call
}

bool goesOn() { return found <= MOST_PAIRS_A_TRIANGLE; }
bool looksAtFlat() { return false; }
#include "sim/surface/walk.glsl"

#if WRITES_PAIRS
uint startOf(uint triangle) {
  return triangle < surface.triangles ? counts[triangle] + texelFetch(blockStarts, int(triangle / SURFACE_BLOCK)).x : state.pairs;
}
#endif

void main() {
  uint own = thisEntry();
  if (own >= surface.triangles || isSettled()) return;
#if WRITES_PAIRS
  if (state.tooMany != 0u) return;
  firstFound = startOf(own);
  if (startOf(own + 1u) == firstFound) return;  // it has found none
  firstPlace = own * (surface.smallColliders + 1u);
#else
  counts[own] = 0u;
  if (state.tooMany == 2u) return;
#endif
  if (surface.touchesItself != 0u && state.isFlat == 0u) lookAround(own);
#if HAS_SMALL_COLLIDERS
  lookAtColliders(own);
#endif
#if !WRITES_PAIRS
  counts[own] = found;
  if (found > MOST_PAIRS_A_TRIANGLE) atomicOr(state.tooMany, 1u);
#endif
}
