// How a particle's part of the energy would change along the Newton step, at four lengths of it: its inertia, the springs it
// owns and the lines of bending that it is in the middle of. Differences are taken where they arise, so that little ones
// are exact. As a sum, for scenes with one cloth, they are added up at once (sim/implicit/total.glsl).
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/common.glsl"
#include "sim/watch.glsl"
#include "sim/incident_springs.glsl"
#include "sim/implicit/energy.glsl"
#include "sim/implicit/contact.glsl"
#if HAS_SURFACE
#include "sim/surface/pairs_of_particles.glsl"
#endif
#if HAS_MESH
#include "sim/implicit/mesh.glsl"
#endif
#if HAS_SEAMS
#include "sim/implicit/seam_trials.glsl"
#endif

#if IS_SUM
#include "sim/implicit/total.glsl"
#else
layout(std430, binding = PRODUCTS_BINDING) writeonly buffer Trials { vec4 trials[]; };
#endif

// A line of three particles around one in the middle: b (l k.dk + l^2/2 |dk|^2), k = (m - a) + (m - c).
vec4 addBendingTrial(vec4 trial, uint m, uint stride, float b) {
  vec4 xm = iterateAt(m), xa = iterateAt(m - stride), xc = iterateAt(m + stride);
  bool endOfClamp = xm.w == 0.0 && (xa.w == 0.0) != (xc.w == 0.0);
  precise float weighted = endOfClamp ? 2.0 * b : b;
  precise vec3 k = (xm.xyz - xa.xyz) + (xm.xyz - xc.xyz);
  precise vec3 dk = (incrementAt(m) - incrementAt(m - stride)) + (incrementAt(m) - incrementAt(m + stride));
  precise float first = sumOfProducts(k, dk);
  precise float second = sumOfProducts(dk, dk);
  precise vec4 sum = trial + (weighted * lengthsTried) * (first + (0.5 * lengthsTried) * second);
  return sum;
}

vec4 addBendingTrials(GridPoint p, vec4 trial, uint cut) {
  bool borderRow = p.row == 0u || p.row + 1u == step.rows;
  bool borderColumn = p.column == 0u || p.column + 1u == step.columns;
  precise float alongRow = borderRow ? 0.5 * step.bendAlongRow : step.bendAlongRow;
  precise float alongColumn = borderColumn ? 0.5 * step.bendAlongColumn : step.bendAlongColumn;
  if (!borderColumn && (cut & BENDING_ROW) == 0u) trial = addBendingTrial(trial, p.index, 1u, alongRow);
  if (!borderRow && (cut & BENDING_COLUMN) == 0u) trial = addBendingTrial(trial, p.index, step.columns, alongColumn);
  return trial;
}

#if HAS_SURFACE
vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

// Those of the pairs whose first particle this is.
vec4 addPairTrials(uint i, vec4 trial) {
  uvec2 range = pairsOf(i);
  float slow = slowSlip();
  for (uint k = range.x; k < range.y; ++k) {
    uint entry = pairEntry(k), q = entry / 4u;
    if (entry % 4u != 0u) continue;
    uvec4 ids = texelFetch(pairIds, int(q));
    vec4 normal = pairRow(q, 0u), weights = pairRow(q, 1u), law = pairRow(q, 2u);
    vec3 d = weightedSum(weights, displacementAt(ids.x), displacementAt(ids.y), displacementAt(ids.z), displacementAt(ids.w));
    vec3 e = weightedSum(weights, incrementAt(ids.x), incrementAt(ids.y), incrementAt(ids.z), incrementAt(ids.w));
    float along = sumOfProducts(normal.xyz, d), fall = sumOfProducts(normal.xyz, e);
    precise float over = normal.w - along;
    vec3 relative = relativeToPair(q, d);
    precise vec3 slip = relative - sumOfProducts(normal.xyz, relative) * normal.xyz;
    precise vec3 slide = e - fall * normal.xyz;
    float resisted = frictionPotential(slip, slow);
    for (int t = 0; t < LENGTHS_TRIED; ++t) {
      precise float overAfter = over - lengthsTried[t] * fall;
      precise vec3 slipAfter = slip + lengthsTried[t] * slide;
      precise float sum = trial[t] + (contactChange(law.x, over, overAfter) + law.z * (frictionPotential(slipAfter, slow) - resisted));
      trial[t] = sum;
    }
  }
  return trial;
}
#endif

vec4 trialAt(GridPoint p) {
  uint i = p.index;
  vec3 x = iterateAt(i).xyz, e = incrementAt(i), displacement = texelFetch(displacements, int(i)).xyz;
  vec4 rightHandSide = texelFetch(rightHandSides, int(i));
  precise vec3 force = rightHandSide.w * displacement;
  precise vec3 product = rightHandSide.w * e;
  if (hasWind && iterateAt(i).w != 0.0) {
    force = force + timesVector(airBlockAt(i), displacement);
    product = product + timesVector(airBlockAt(i), e);
  }
  precise vec3 slope = force - rightHandSide.xyz;
  precise float first = sumOfProducts(slope, e);
  precise float second = 0.5 * sumOfProducts(product, e);
  precise vec4 trial = lengthsTried * (first + lengthsTried * second);
#if HAS_SURFACE
  trial = addPairTrials(i, trial);
#endif
  if (hasContacts) {
    vec4 plane = contactPlaneAt(i);
    precise float over = plane.w - sumOfProducts(plane.xyz, displacement);
    float fall = sumOfProducts(plane.xyz, e), stiffness = contactStiffness(rightHandSide.w);
    bool hasPlane = sumOfProducts(plane.xyz, plane.xyz) > 0.0;
    vec3 slip = slipOf(plane.xyz, carryAt(i).xyz, displacement);
    precise vec3 slide = e - fall * plane.xyz;
    float limit = frictionLimitAt(i), slow = slowSlip(), resisted = frictionPotential(slip, slow);
    for (int k = 0; k < LENGTHS_TRIED; ++k) {
      precise float overAfter = over - lengthsTried[k] * fall;
      precise vec3 slipAfter = slip + lengthsTried[k] * slide;
      precise float change = contactChange(stiffness, over, overAfter) + limit * (frictionPotential(slipAfter, slow) - resisted);
      precise float changed = trial[k] + change;
      trial[k] = hasPlane ? changed : trial[k];
    }
  }
#if HAS_SEAMS
  trial = addSeamTrials(i, trial);
#endif
#if HAS_MESH
  trial = addMeshTrials(i, trial);
#else
  uint cut = cutMaskOf(i);
  for (uint k = 0u; k < OWNED_SPRINGS; ++k) {
    IncidentSpring spring = incidentSpring(p, k, cut);
    if (!spring.exists) continue;
    precise vec3 d = iterateAt(spring.other).xyz - x;
    precise vec3 de = incrementAt(spring.other) - e;
    for (int t = 0; t < LENGTHS_TRIED; ++t) {
      precise float sum = trial[t] + springChange(d, de, lengthsTried[t], spring);
      trial[t] = sum;
    }
  }
  if (hasMaterial) trial = addBendingTrials(p, trial, cut);
#endif
  return trial;
}

void main() {
  if (isSkipped()) return;
#if IS_SUM
  uint first = gl_WorkGroupID.x * SUM_BLOCK + gl_LocalInvocationIndex;
  Sum sum = Sum(0.0);
  for (uint i = first; i < first + SUM_BLOCK && i < step.totalParticles; i += uint(SUM_LANES))
    sum = joined(sum, trialAt(pointOf(i)));
  addToTotal(sum);
#else
  GridPoint p = thisGridPoint();
  if (p.exists) trials[p.index] = trialAt(p);
#endif
}
