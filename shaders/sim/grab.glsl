// What a person does to the cloth: a soft spring that pulls grabbed particles, and a jet of air. The formulas are at src/solver/interaction.h, the twin is in
// src/solver/cpu/passes.cpp.
layout(std140, binding = INTERACTION_PARAMS_BINDING) uniform InteractionBlock { InteractionParams interaction; };
layout(binding = GRABBED_UNIT) uniform samplerBuffer grabbed;

// The velocity that a grab leaves to a particle at x, of velocity v after all forces.
vec3 pulledVelocity(GridPoint p, vec3 x, vec3 v) {
  uint column = p.column - interaction.firstColumn, row = p.row - interaction.firstRow;  // before the block: beyond it
  if (column >= interaction.columns || row >= interaction.rows) return v;
  vec4 point = texelFetch(grabbed, int(row * interaction.columns + column));
  precise vec3 own = canonical(v);
  precise vec3 goal = vec3(interaction.goalX, interaction.goalY, interaction.goalZ) + point.xyz;
  precise vec3 towards = goal - x;
  precise vec3 pulled = (interaction.velocityKept * own + interaction.pull * towards) + vec3(interaction.pushX, interaction.pushY, interaction.pushZ);
  precise float speedSquared = sumOfProducts(pulled, pulled);
  precise float slower = interaction.largestSpeed * inverseSquareRoot(speedSquared);
  if (interaction.largestSpeedSquared < speedSquared) pulled = slower * pulled;
  precise vec3 result = own + point.w * (pulled - own);
  return result;
}

// What of the jet arrives at x, 0 to 1.
float jetShare(vec3 x) {
  vec3 direction = vec3(interaction.directionX, interaction.directionY, interaction.directionZ);
  precise vec3 d = x - vec3(interaction.originX, interaction.originY, interaction.originZ);
  precise float along = sumOfProducts(d, direction);
  precise vec3 across = d - along * direction;
  precise float inside = 1.0 - interaction.inverseRadiusSquared * sumOfProducts(across, across);
  precise float rise = interaction.inverseRadius * along;
  float risen = rise < 1.0 ? rise : 1.0;
  precise float share = (inside * inside) * risen;
  return inside > 0.0 && rise > 0.0 ? canonical(share) : 0.0;
}
