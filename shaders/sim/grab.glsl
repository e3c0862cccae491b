// Hands on the cloth: particles held by a soft spring, and a jet of air. The formulas are at src/solver/grab.h, the twin is in
// src/solver/cpu/passes.cpp.
layout(std140, binding = HAND_PARAMS_BINDING) uniform HandBlock { HandParams hand; };
layout(binding = GRABBED_UNIT) uniform samplerBuffer grabbed;

// The velocity that a hand leaves to a particle at x, of velocity v after all forces.
vec3 pulledVelocity(GridPoint p, vec3 x, vec3 v) {
  uint column = p.column - hand.firstColumn, row = p.row - hand.firstRow;  // before the block: beyond it
  if (column >= hand.columns || row >= hand.rows) return v;
  vec4 point = texelFetch(grabbed, int(row * hand.columns + column));
  precise vec3 own = canonical(v);
  precise vec3 goal = vec3(hand.goalX, hand.goalY, hand.goalZ) + point.xyz;
  precise vec3 towards = goal - x;
  precise vec3 pulled = (hand.velocityKept * own + hand.pull * towards) + vec3(hand.pushX, hand.pushY, hand.pushZ);
  precise float speedSquared = sumOfProducts(pulled, pulled);
  precise float slower = hand.largestSpeed * inverseSquareRoot(speedSquared);
  if (hand.largestSpeedSquared < speedSquared) pulled = slower * pulled;
  precise vec3 result = own + point.w * (pulled - own);
  return result;
}

// What of the jet arrives at x, 0 to 1.
float jetShare(vec3 x) {
  vec3 direction = vec3(hand.directionX, hand.directionY, hand.directionZ);
  precise vec3 d = x - vec3(hand.originX, hand.originY, hand.originZ);
  precise float along = sumOfProducts(d, direction);
  precise vec3 across = d - along * direction;
  precise float inside = 1.0 - hand.inverseRadiusSquared * sumOfProducts(across, across);
  precise float rise = hand.inverseRadius * along;
  float risen = rise < 1.0 ? rise : 1.0;
  precise float share = (inside * inside) * risen;
  return inside > 0.0 && rise > 0.0 ? canonical(share) : 0.0;
}
