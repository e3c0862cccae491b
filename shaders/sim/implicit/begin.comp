// The start of an implicit step: what inertia, air and hands make of a particle's way d, the energy 1/2 a |d|^2 - b.d with
// a symmetric matrix beside a where wind blows; and the way to start from. Pins go where their paths take them.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"

layout(std430, binding = FIRST_OUTPUT_BINDING) writeonly buffer Anchors { vec4 newAnchors[]; };
layout(std430, binding = SECOND_OUTPUT_BINDING) writeonly buffer Ways { vec4 newWays[]; };
layout(std430, binding = THIRD_OUTPUT_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };
layout(std430, binding = FOURTH_OUTPUT_BINDING) writeonly buffer AirBlocks { vec4 newAirBlocks[]; };

vec4 holdParticle(GridPoint p, vec3 x, float mass, vec4 anchor) {
  uint column = p.column - hand.firstColumn, row = p.row - hand.firstRow;  // before the block: beyond it
  if (column >= hand.columns || row >= hand.rows) return anchor;
  vec4 point = texelFetch(held, int(row * hand.columns + column));
  precise vec3 goal = vec3(hand.goalX, hand.goalY, hand.goalZ) + point.xyz;
  precise vec3 towards = goal - x;
  precise vec3 way = hand.reach * (hand.pull * towards + vec3(hand.pushX, hand.pushY, hand.pushZ));
  precise float waySquared = sumOfProducts(way, way);
  precise float shorter = hand.largestWay * inverseSquareRoot(waySquared);
  if (hand.largestWaySquared < waySquared) way = shorter * way;
  precise float stiffness = (point.w * hand.resistance) * ((mass * step.inverseTimeStep) * step.inverseTimeStep);
  precise vec3 b = anchor.xyz + stiffness * way;
  precise float a = anchor.w + stiffness;
  return vec4(b, a);
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i), velocity = texelFetch(velocities, int(i));
  vec3 v = velocity.xyz, gravity = vec3(step.gravityX, step.gravityY, step.gravityZ);
  if (x.w == 0.0) {
    vec3 target = x.xyz;
    if (hasMovingPins) target = movePin(i, x).position.xyz;
    precise vec3 way = target - x.xyz;
    newAnchors[i] = vec4(0.0);
    newWays[i] = vec4(way, 0.0);
    newIterates[i] = vec4(target, 0.0);
    return;
  }
  precise float mass = reciprocal(x.w);
  precise float stiffness = mass * step.inertia;
  precise vec3 moved = step.guessTime * (v + step.timeStep * gravity);
  vec3 guess = canonical(moved);
  precise vec3 b = stiffness * guess;
  if (hasAirResistance) {  // -a |v| v', linear in the new velocity v'
    precise float speedSquared = sumOfProducts(v, v);
    precise float speed = speedSquared * inverseSquareRoot(speedSquared);
    stiffness = stiffness + (step.airResistance * speed) * step.inverseTimeStep;
  }
  if (hasWind) {  // f - R (v' - v)
#if HAS_MESH
    vec3 force = addListedTriangles(texelFetch(listStarts, int(i)).z, texelFetch(listStarts, int(i) + 1).z, vec3(0.0));
#else
    vec3 force = addWind(p, vec3(0.0));
#endif
    Symmetric resistance = Symmetric(resistanceDiagonal, resistanceOthers);
    precise vec3 push = force + timesVector(resistance, v);
    b = b + push;
    precise vec3 diagonal = step.inverseTimeStep * resistance.diagonal;
    precise vec3 others = step.inverseTimeStep * resistance.others;
    newAirBlocks[2u * i] = vec4(diagonal, 0.0);
    newAirBlocks[2u * i + 1u] = vec4(others, 0.0);
  }
  vec4 anchor = vec4(b, stiffness);
  if (hasHold) anchor = holdParticle(p, x.xyz, mass, anchor);
  precise float falls = 1.0 - velocity.w;
  precise vec3 likely = step.guessTime * (v + (falls * step.timeStep) * gravity);
  vec3 start = canonical(likely);
  precise vec3 place = x.xyz + start;
  newAnchors[i] = anchor;
  newWays[i] = vec4(start, 0.0);
  newIterates[i] = vec4(canonical(place), x.w);
}
