// The last word of robust self-collision: when some pair of non-adjacent particles has come nearer than D, all motion of the step is cut
// short by pairs: each of two may go half of what lies between them and D, so that they cannot meet.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/self/common.glsl"
#include "sim/self/cells.glsl"

void look(uint i, uint candidate);
#include "sim/self/pairs.glsl"

float kept = 1.0;  // of the particle's motion
vec3 here, start;

void look(uint i, uint candidate) {
  uint j = candidate & INDEX_MASK;
  vec4 other = texelFetch(positionsSoFar, int(j));
  vec3 otherStart = positionAt(j).xyz;
  precise float least = self.clampFactor * pairDistance(candidate);
  precise vec3 d = start - otherStart;
  precise float lengthSquared = sumOfProducts(d, d);
  precise float inverseLength = inverseSquareRoot(lengthSquared);
  precise vec3 normal = inverseLength * d;
  precise float gap = lengthSquared * inverseLength - least;
  precise float slack = gap < 0.0 ? 0.0 : gap;
  precise vec3 motion = here - start;
  precise vec3 otherMotion = other.xyz - otherStart;
  precise float away = sumOfProducts(motion, normal);
  precise float closing = -away;
  precise float otherClosing = sumOfProducts(otherMotion, normal);
  precise float taken = otherClosing < 0.0 ? 0.0 : otherClosing;
  precise float left = slack - taken;
  left = slack < taken ? 0.0 : left;
  precise float allHalf = 0.5 * slack;
  precise float allowed = other.w == 0.0 ? left : allHalf;
  precise float part = allowed * reciprocal(closing);
  precise float now = allowed < closing ? part : 1.0;
  kept = now < kept ? now : kept;
}

void main() {
  if (contacts.clamping == 0u) return;
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec4 position = texelFetch(positionsSoFar, int(p.index));
  if (position.w == 0.0) return;
  here = position.xyz;
  start = positionAt(p.index).xyz;
  lookAtCandidates(p);
  if (!(kept < 1.0)) return;
  precise vec3 stopped = start + kept * (here - start);
  vec4 velocity = texelFetch(velocitiesSoFar, int(p.index));
  precise vec3 v = velocity.xyz + self.inverseTimeStep * (stopped - here);
  newPositions[p.index] = vec4(canonical(stopped), position.w);
  newVelocities[p.index] = vec4(canonical(v), velocity.w);
}
