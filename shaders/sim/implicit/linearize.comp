// From the elastic forces at the iterate: residuals, and the blocks of the preconditioner (src/solver/implicit.h). Clears the
// increments. POSITIONS_UNIT: the iterate.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/incident_springs.glsl"
#include "sim/implicit/contact.glsl"
#if HAS_SURFACE
#include "sim/surface/pairs_of_particles.glsl"
#endif
#if HAS_MESH
#include "sim/implicit/mesh.glsl"
#endif
#if HAS_SEAMS
#include "sim/implicit/seams.glsl"
#endif

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };
layout(std430, binding = FACTORS_BINDING) writeonly buffer FactorsOut { vec4 newFactors[]; };
layout(std430, binding = CONTACT_BLOCKS_BINDING) writeonly buffer ContactBlocks { vec4 newContactBlocks[]; };
layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

void storeFactors(uint i, Factors f) {
  newFactors[2u * i] = vec4(f.lower, 0.0);
  newFactors[2u * i + 1u] = vec4(f.inverse, 0.0);
}
void storeContactBlock(uint i, Symmetric contact, float frictionLimit) {
  newContactBlocks[2u * i] = vec4(contact.diagonal, frictionLimit);
  newContactBlocks[2u * i + 1u] = vec4(contact.others, 0.0);
}

// What bending adds to the diagonal block of particle i of `count` in a line, of those `stride` apart.
float bendingBlock(uint index, uint i, uint count, uint stride, float b, uint cut, uint before, uint around, uint after) {
  precise float sum = 0.0;
  if (i >= 2u && (cut & before) == 0u) {
    bool endOfClamp = positionAt(index - stride).w == 0.0 && (positionAt(index - 2u * stride).w == 0.0) != (positionAt(index).w == 0.0);
    precise float weighted = endOfClamp ? 2.0 * b : b;
    sum = sum + weighted;
  }
  if (i >= 1u && i + 1u < count && (cut & around) == 0u) {
    bool endOfClamp = positionAt(index).w == 0.0 && (positionAt(index - stride).w == 0.0) != (positionAt(index + stride).w == 0.0);
    precise float weighted = endOfClamp ? 2.0 * b : b;
    sum = sum + 4.0 * weighted;
  }
  if (i + 2u < count && (cut & after) == 0u) {
    bool endOfClamp = positionAt(index + stride).w == 0.0 && (positionAt(index).w == 0.0) != (positionAt(index + 2u * stride).w == 0.0);
    precise float weighted = endOfClamp ? 2.0 * b : b;
    sum = sum + weighted;
  }
  return sum;
}

Symmetric addBendingBlock(GridPoint p, Symmetric block) {
  bool borderRow = p.row == 0u || p.row + 1u == step.rows;
  bool borderColumn = p.column == 0u || p.column + 1u == step.columns;
  precise float alongRow = borderRow ? 0.5 * step.bendAlongRow : step.bendAlongRow;
  precise float alongColumn = borderColumn ? 0.5 * step.bendAlongColumn : step.bendAlongColumn;
  uint cut = cutMaskOf(p.index);
  precise float b =
      bendingBlock(p.index, p.column, step.columns, 1u, alongRow, cut, BENDING_LEFT, BENDING_ROW, BENDING_RIGHT) +
      bendingBlock(p.index, p.row, step.rows, step.columns, alongColumn, cut, BENDING_UPPER, BENDING_COLUMN, BENDING_LOWER);
  precise vec3 diagonal = block.diagonal + vec3(b);
  return Symmetric(diagonal, block.others);
}

// Which plane holds in this Newton step, and what friction does there: src/solver/cpu/implicit_contact.h.
void addContact(uint i, float diagonal, vec3 d, inout vec3 residual, inout Symmetric block) {
  vec4 plane = contactPlaneAt(i), carry = carryAt(i);
  vec3 normal = plane.xyz;
  precise float over = plane.w - sumOfProducts(normal, d);
  float own = sumOfProducts(normal, timesVector(block, normal));
  precise float push = own * over - sumOfProducts(normal, residual);
  bool hasPlane = sumOfProducts(normal, normal) > 0.0, presses = hasPlane && push > 0.0;
  float before = scalars.newtonSteps == 0u ? contactBlockAt(i).diagonal.x : 0.0;  // find_planes.comp
  bool held = hasPlane && before > 0.0;
  bool holds = presses || held || (hasPlane && over > 0.0);
  float stiffness = holds ? contactStiffness(diagonal) : 0.0;
  precise float both = stiffness + own;
  precise float carried = push * (stiffness * reciprocal(both));
  precise float most = carry.w * carried;
  float follows = presses ? most : 0.0;
  float limit = held ? limitOf(before) : frictionFollows() ? follows : frictionLimitAt(i);
  vec3 slip = slipOf(normal, carry.xyz, d);
  float squared = sumOfProducts(slip, slip), inverse = inverseSquareRoot(squared);
  precise float len = squared * inverse;
  FrictionSlope slope = frictionSlope(len, inverse, slowSlip());
  precise float across = limit * slope.over;
  precise float secant = across - LIGHT * diagonal;
  precise float tangent = limit * slope.along;
  float along = larger(larger(secant, 0.0), tangent);
  precise float normalPart = stiffness - across;
  precise float slipPart = along - across;
  precise vec3 direction = inverse * slip;
  Symmetric contact = sumOf(outerProduct3(normalPart, normal), outerProduct3(slipPart, direction));
  precise vec3 contactDiagonal = contact.diagonal + vec3(across);
  contact.diagonal = contactDiagonal;
  precise vec3 with = residual + ((stiffness * over) * normal - across * slip);
  residual = with;
  block = sumOf(block, contact);
  storeContactBlock(i, contact, limit);
}

#if HAS_SURFACE
void addPairs(uint i, inout vec3 residual, inout Symmetric block) {
  uvec2 range = pairsOf(i);
  for (uint k = range.x; k < range.y; ++k) {
    uint entry = pairEntry(k), q = entry / 4u;
    vec4 force = pairRow(q, 3u);
    float weight = pairRow(q, 1u)[entry % 4u];
    precise float square = weight * weight;
    precise float across = square * force.w;
    precise float beyond = square * (pairRow(q, 2u).w - force.w);
    precise vec3 with = residual + weight * force.xyz;
    residual = with;
    Symmetric sum = sumOf(block, outerProduct3(beyond, pairRow(q, 0u).xyz));
    precise vec3 diagonal = sum.diagonal + vec3(across);
    block = Symmetric(diagonal, sum.others);
  }
}
#endif

void main() {
  if (isSkipped()) return;
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  newIncrements[i] = vec4(0.0);
  if (x.w == 0.0) {
    newResiduals[i] = vec4(0.0);
    storeFactors(i, Factors(vec3(0.0), vec3(0.0)));
    if (hasContacts) storeContactBlock(i, Symmetric(vec3(0.0), vec3(0.0)), 0.0);
    return;
  }

  vec4 rightHandSide = texelFetch(rightHandSides, int(i));
  Symmetric block = Symmetric(vec3(rightHandSide.w), vec3(0.0)), air = Symmetric(vec3(0.0), vec3(0.0));
  if (hasWind) {
    air = airBlockAt(i);
    block = sumOf(block, air);
  }
#if HAS_MESH
  block = addMeshBlocks(i, block);
#else
  uint cut = cutMaskOf(i);
  for (uint k = 0u; k < INCIDENT_SPRINGS; ++k) {
    IncidentSpring spring = incidentSpring(p, k, cut);
    if (!spring.exists) continue;
    vec4 end = positionAt(spring.other);
    precise vec3 d = end.xyz - x.xyz;
    SpringBlock s = springBlock(d, spring, false);
    Symmetric outer = outerProduct3(s.along, d);
    precise vec3 diagonal = outer.diagonal + vec3(s.across);
    block = sumOf(block, Symmetric(diagonal, outer.others));
  }
  if (hasMaterial) block = addBendingBlock(p, block);
#endif
#if HAS_SEAMS
  block = addSeamBlocks(i, block);
#endif

  vec3 displacement = texelFetch(displacements, int(i)).xyz;
  precise vec3 pull = rightHandSide.xyz - rightHandSide.w * displacement;
  if (hasWind) pull = pull - timesVector(air, displacement);
  precise vec3 sum = pull + forces[i].xyz;
  vec3 residual = sum;
#if HAS_SURFACE
  addPairs(i, residual, block);
#endif
  if (hasContacts) addContact(i, rightHandSide.w, displacement, residual, block);
  newResiduals[i] = vec4(canonical(residual), 0.0);
  storeFactors(i, factorize(block));
}
