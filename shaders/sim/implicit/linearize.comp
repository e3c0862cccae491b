// From the elastic forces at the iterate: residuals, and the blocks of the preconditioner (src/solver/implicit.h). Clears the
// increments. POSITIONS_UNIT: the iterate.
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/incident_springs.glsl"
#include "sim/implicit/contact.glsl"
#if HAS_MESH
#include "sim/implicit/mesh.glsl"
#endif

layout(std430, binding = RESIDUALS_BINDING) writeonly buffer Residuals { vec4 newResiduals[]; };
layout(std430, binding = FACTORS_BINDING) writeonly buffer FactorsOut { vec4 newFactors[]; };
layout(std430, binding = INCREMENTS_BINDING) writeonly buffer Increments { vec4 newIncrements[]; };

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

void main() {
  if (isSkipped()) return;
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  uint i = p.index;
  vec4 x = positionAt(i);
  newResiduals[i] = vec4(0.0);
  newIncrements[i] = vec4(0.0);
  newFactors[2u * i] = vec4(0.0);
  newFactors[2u * i + 1u] = vec4(0.0);
  if (x.w == 0.0) return;

  vec4 rightHandSide = texelFetch(rightHandSides, int(i));
  Symmetric block = Symmetric(vec3(rightHandSide.w), vec3(0.0)), air = Symmetric(vec3(0.0), vec3(0.0));
  if (hasWind) {
    air = airBlockAt(i);
    block = sumOf(block, air);
  }
  if (hasContacts) {
    float grip = gripAt(i);
    precise float across = contactStiffness(rightHandSide.w) - grip;
    block = sumOf(block, outerProduct3(across, contactPlaneAt(i).xyz));
    precise vec3 diagonal = block.diagonal + vec3(grip);
    block.diagonal = diagonal;
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
    SpringBlock s = springBlock(d, spring);
    Symmetric outer = outerProduct3(s.along, d);
    precise vec3 diagonal = outer.diagonal + vec3(s.across);
    block = sumOf(block, Symmetric(diagonal, outer.others));
  }
  if (hasMaterial) block = addBendingBlock(p, block);
#endif

  vec3 displacement = texelFetch(displacements, int(i)).xyz;
  precise vec3 pull = rightHandSide.xyz - rightHandSide.w * displacement;
  if (hasWind) pull = pull - timesVector(air, displacement);
  if (hasContacts) {
    vec4 plane = contactPlaneAt(i);
    pull = pull + contactPush(plane, rightHandSide.w, displacement) * plane.xyz;
    pull = pull - gripAt(i) * slipOf(plane.xyz, carryAt(i).xyz, displacement);
  }
  precise vec3 residual = pull + forces[i].xyz;
  newResiduals[i] = vec4(canonical(residual), 0.0);
  Factors f = factorize(block);
  newFactors[2u * i] = vec4(f.lower, 0.0);
  newFactors[2u * i + 1u] = vec4(f.inverse, 0.0);
}
