// Resolve contacts: particles nearer than their distance go apart, by half of what is missing each (all of it for CS184's rule, and next
// to a pinned particle); friction takes back what they slid past each other in this step, up to its coefficient times that. A
// particle moves by the mean over its contacts, summed in fixed-point units, so that their order does not matter.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/self/common.glsl"
#include "sim/self/cells.glsl"

void look(uint i, uint candidate);
#include "sim/self/pairs.glsl"

uvec3 sum = uvec3(0u);
uint contactCount = 0u;
vec3 here, start;  // the particle, now and at the start of the step

// The nearest whole number, for |x| < 2^22: adding 1.5 * 2^23 leaves it in the low bits.
uint toFixedPoint(float x) {
  precise float shifted = x + 12582912.0;
  return floatBitsToUint(shifted) - 0x4b400000u;
}
// In two halves, each of which converts exactly.
float fromFixedPoint(uint sum) {
  precise float high = float(int(sum) >> 12), low = float(int(sum) & 4095);
  precise float result = high * 4096.0 + low;
  return result;
}

void look(uint i, uint candidate) {
  uint j = candidate & INDEX_MASK;
  vec4 other = texelFetch(positionsSoFar, int(j));
  precise float limit = pairDistance(candidate);
  precise float limitSquared = limit * limit;
  precise vec3 d = here - other.xyz;
  precise float lengthSquared = sumOfProducts(d, d);
  if (!(lengthSquared < limitSquared)) return;
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise float depth = limit - lengthSquared * inverseLength;
  precise vec3 normal = inverseLength * d;
  if (lengthSquared == 0.0) normal.y = i < j ? -1.0 : 1.0;  // two particles at one place
  precise vec3 move = depth * normal;
  if (SELF_ROBUST != 0) {
    precise vec3 motion = here - start;
    precise vec3 otherMotion = other.xyz - positionAt(j).xyz;
    precise vec3 relative = motion - otherMotion;
    precise float along = sumOfProducts(relative, normal);
    precise vec3 slip = relative - along * normal;
    precise float slipSquared = sumOfProducts(slip, slip);
    precise float reach = self.friction * depth;
    precise float reachSquared = reach * reach;
    precise float part = reach * inverseSquareRoot(slipSquared);
    precise float share = other.w == 0.0 ? 1.0 : 0.5;
    precise float taken = reachSquared < slipSquared ? part : 1.0;
    move = share * (move - taken * slip);
  }
  precise vec3 units = self.unitsPerMeter * move;
  sum += uvec3(toFixedPoint(units.x), toFixedPoint(units.y), toFixedPoint(units.z));
  ++contactCount;
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 position = texelFetch(positionsSoFar, int(p.index));
  here = position.xyz;
  start = positionAt(p.index).xyz;
  if (position.w > 0.0 && contacts.broken == 0u) lookAtCandidates(p);
  if (contactCount == 0u) {
    newPositions[p.index] = position;
    return;
  }
  precise float factor = self.moveFactor * reciprocal(float(contactCount));
  precise vec3 move = factor * vec3(fromFixedPoint(sum.x), fromFixedPoint(sum.y), fromFixedPoint(sum.z));
  if (SELF_ROBUST != 0) {
    precise float lengthSquared = sumOfProducts(move, move);
    precise float largestSquared = self.largestMove * self.largestMove;
    precise float shorter = self.largestMove * inverseSquareRoot(lengthSquared);
    if (largestSquared < lengthSquared) move = shorter * move;
  }
  precise vec3 x = here + move;
  vec4 velocity = texelFetch(velocitiesSoFar, int(p.index));
  precise vec3 v = velocity.xyz + self.inverseTimeStep * move;
  newPositions[p.index] = vec4(canonical(x), position.w);
  newVelocities[p.index] = vec4(canonical(v), velocity.w);
}
