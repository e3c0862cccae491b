// The start of an implicit step: what inertia, air and grabs make of a particle's displacement d, the energy 1/2 a |d|^2 - b.d with
// a symmetric matrix beside a where wind blows. Pins go where their paths take them.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/forces.glsl"
#include "sim/integrate.glsl"
#include "sim/implicit/contact.glsl"
#include "sim/implicit/time_scheme.glsl"

layout(std430, binding = RIGHT_HAND_SIDES_BINDING) writeonly buffer RightHandSides { vec4 newRightHandSides[]; };
layout(std430, binding = DISPLACEMENTS_BINDING) writeonly buffer Displacements { vec4 newDisplacements[]; };
layout(std430, binding = ITERATES_BINDING) writeonly buffer Iterates { vec4 newIterates[]; };
layout(std430, binding = AIR_BLOCKS_BINDING) writeonly buffer AirBlocks { vec4 newAirBlocks[]; };

vec4 grabParticle(GridPoint p, vec3 x, float mass, vec4 rightHandSide) {
  uint column = p.column - interaction.firstColumn, row = p.row - interaction.firstRow;  // before the block: beyond it
  if (column >= interaction.columns || row >= interaction.rows) return rightHandSide;
  vec4 point = texelFetch(grabbed, int(row * interaction.columns + column));
  precise vec3 goal = vec3(interaction.goalX, interaction.goalY, interaction.goalZ) + point.xyz;
  precise vec3 towards = goal - x;
  precise vec3 displacement = interaction.reach * (interaction.pull * towards + vec3(interaction.pushX, interaction.pushY, interaction.pushZ));
  precise float displacementSquared = sumOfProducts(displacement, displacement);
  precise float shorter = interaction.largestDisplacement * inverseSquareRoot(displacementSquared);
  if (interaction.largestDisplacementSquared < displacementSquared) displacement = shorter * displacement;
  precise float stiffness = (point.w * interaction.resistance) * ((mass * step.inverseTimeStep) * step.inverseTimeStep);
  precise vec3 b = rightHandSide.xyz + stiffness * displacement;
  precise float a = rightHandSide.w + stiffness;
  return vec4(b, a);
}

void storeAirBlock(uint i, Symmetric air) {
  newAirBlocks[2u * i] = vec4(air.diagonal, 0.0);
  newAirBlocks[2u * i + 1u] = vec4(air.others, 0.0);
}

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  vec3 v = velocityAt(i), gravity = vec3(step.gravityX, step.gravityY, step.gravityZ);
  if (x.w == 0.0) {
    vec3 target = x.xyz;
    if (hasMovingPins) target = movePin(i, x).position.xyz;
    precise vec3 displacement = target - x.xyz;
    newRightHandSides[i] = vec4(0.0);
    newDisplacements[i] = vec4(displacement, 0.0);
    newIterates[i] = vec4(target, 0.0);
    if (hasWind) storeAirBlock(i, Symmetric(vec3(0.0), vec3(0.0)));  // 0 times what nobody has written may be no number
    return;
  }
  TimeScheme scheme = timeScheme();
  vec3 moving = v, carried = vec3(0.0);
  if (scheme.isSecondOrder) {
    precise vec3 sum = v + acceleratedBefore(i);
    moving = sum;
    carried = movedBefore(i);
  }
  precise float mass = reciprocal(x.w);
  precise float stiffness = mass * scheme.inertia;
  precise vec3 guess = scheme.guessTime * (moving + scheme.gravityTime * gravity);
  if (scheme.isSecondOrder) guess = guess + carried;
  precise vec3 b = stiffness * canonical(guess);
  vec4 withForces = addParticleForcesToSystem(x.xyz, v, mass, scheme.rate, scheme.isSecondOrder, carried, vec4(b, stiffness));
  b = withForces.xyz;
  stiffness = withForces.w;
  if (hasExternalForces) b = b + texelFetch(externalForces, int(i)).xyz;
  if (hasWind) {  // f - R (v' - v)
#if HAS_MESH
    vec3 force = addMeshTriangles(texelFetch(listStarts, int(i)).z, texelFetch(listStarts, int(i) + 1).z, vec3(0.0));
#else
    vec3 force = addWind(p, vec3(0.0));
#endif
    Symmetric resistance = Symmetric(resistanceDiagonal, resistanceOthers);
    precise vec3 push = force + timesVector(resistance, v);
    b = b + push;
    precise vec3 diagonal = scheme.rate * resistance.diagonal;
    precise vec3 others = scheme.rate * resistance.others;
    if (scheme.isSecondOrder) b = b + timesVector(Symmetric(diagonal, others), carried);
    storeAirBlock(i, Symmetric(diagonal, others));
  }
  vec4 rightHandSide = vec4(b, stiffness);
  if (hasGrab) rightHandSide = grabParticle(p, x.xyz, mass, rightHandSide);
  newRightHandSides[i] = rightHandSide;
  precise vec3 way = step.timeStep * v;
  vec3 start = canonical(way);
  if (hasContacts) {
    // Cloth that lies on cloth does not start on the floor below: a plane lifts, and does not pull.
    vec4 plane = contactPlaneAt(i);
    precise float below = plane.w - sumOfProducts(plane.xyz, start);
    if (step.hasSurface == 0u || below > 0.0) start = canonical(onPlane(plane, start));
  }
  precise vec3 place = x.xyz + start;
  newDisplacements[i] = vec4(start, 0.0);
  newIterates[i] = vec4(canonical(place), x.w);
}
