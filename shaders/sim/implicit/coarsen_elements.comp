// The matrix of the first coarse level, from the elements of the cloth: springs, bending, and what acts on single particles;
// a block an invocation. The twin of src/solver/cpu/coarse_elements.cpp. POSITIONS_UNIT: where the step starts. Tension is that of
// there: straight motions, with which the search begins, stretch what turns, and would make turning stiff.
#include "shared/implicit.h"
#include "sim/implicit/scalars.glsl"
#include "sim/implicit/level.glsl"
#include "sim/implicit/store_block.glsl"
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
#include "sim/seams.glsl"
#endif

uvec2 pair;      // row and column of the block
bool isOfAll;    // the column has all vertices, moving as one body about the center of the row
vec3 rowCenter, columnCenter;

// How the vertices of an element follow a rigid body: by sum of c w (t + r x (x - center)) = sigma t + r x y; (sigma, y).
// What it adds to the block: p q^T of the forces of rank 1, and s (sigma, y) (sigma, y)^T of those without a direction.
RigidBlock outer = noBlock();
vec4 moments[4] = vec4[4](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));  // columns

// A particle, or an element, as the two vertices see it.
struct Hanging {
  vec4 row, column;
};

// With what weights the particle at x hangs on the two vertices, 0 if it is pinned, and those times where it is from their
// centers.
Hanging hangingOf(uint i, vec4 x) {
  vec2 weights = vec2(0.0);
  uvec2 range = rangeAt(prolongationStarts, i);
  for (uint n = range.x; n < range.y; ++n) {
    Weight weight = weightAt(prolongation, n);
    if (weight.vertex == pair.x) weights.x = weight.weight;
    if (weight.vertex == pair.y) weights.y = weight.weight;
  }
  if (isOfAll) weights.y = 1.0;
  if (x.w == 0.0) weights = vec2(0.0);
  precise vec3 row = weights.x * (x.xyz - rowCenter);
  precise vec3 column = weights.y * (x.xyz - columnCenter);
  return Hanging(vec4(weights.x, row), vec4(weights.y, column));
}
Hanging hangingOf(uint i) { return hangingOf(i, iterateAt(i)); }

// The element s |sigma t + r x y|^2 / 2.
void addIsotropic(float s, Hanging hanging) {
  precise vec4 scaled = s * hanging.row;
  for (int c = 0; c < 4; ++c) {
    precise vec4 sum = moments[c] + scaled * hanging.column[c];
    moments[c] = sum;
  }
}

// The force of the element d on a body: (sigma d, y x d).
RigidVector pullOf(vec4 lever, vec3 d) {
  precise vec3 force = lever.x * d;
  return RigidVector(force, crossProduct(lever.yzw, d));
}
// p q^T.
void addOuter(RigidVector p, RigidVector q) {
  vec3 force = p.translation, torque = p.rotation;
  for (int c = 0; c < 3; ++c) {
    precise vec3 tt = outer.tt[c] + force * q.translation[c];
    precise vec3 tr = outer.tr[c] + force * q.rotation[c];
    precise vec3 rt = outer.rt[c] + torque * q.translation[c];
    precise vec3 rr = outer.rr[c] + torque * q.rotation[c];
    outer.tt[c] = tt;
    outer.tr[c] = tr;
    outer.rt[c] = rt;
    outer.rr[c] = rr;
  }
}
void addPulling(float s, vec3 d, Hanging hanging) {
  RigidVector p = pullOf(hanging.row, d), q = pullOf(hanging.column, d);
  precise vec3 force = s * p.translation;
  precise vec3 torque = s * p.rotation;
  addOuter(RigidVector(force, torque), q);
}

// Cross products with the unit vectors, in components.
RigidBlock blockOfSums() {
  float both = moments[0].x;
  vec3 u = vec3(moments[1].x, moments[2].x, moments[3].x), v = moments[0].yzw;
  precise float trace = (moments[1].y + moments[2].z) + moments[3].w;
  vec3 w[3] = vec3[3](vec3(moments[1].y, moments[2].y, moments[3].y), vec3(moments[1].z, moments[2].z, moments[3].z),
                      vec3(moments[1].w, moments[2].w, moments[3].w));
  vec3 tt[3] = vec3[3](vec3(both, 0.0, 0.0), vec3(0.0, both, 0.0), vec3(0.0, 0.0, both));
  vec3 tr[3] = vec3[3](vec3(0.0, -u.z, u.y), vec3(u.z, 0.0, -u.x), vec3(-u.y, u.x, 0.0));
  vec3 rt[3] = vec3[3](vec3(0.0, v.z, -v.y), vec3(-v.z, 0.0, v.x), vec3(v.y, -v.x, 0.0));
  vec3 rr[3] = vec3[3](vec3(trace, 0.0, 0.0), vec3(0.0, trace, 0.0), vec3(0.0, 0.0, trace));
  RigidBlock block;
  for (int c = 0; c < 3; ++c) {
    precise vec3 sumTT = outer.tt[c] + tt[c];
    precise vec3 sumTR = outer.tr[c] + tr[c];
    precise vec3 sumRT = outer.rt[c] + rt[c];
    precise vec3 sumRR = outer.rr[c] + (rr[c] - w[c]);
    block.tt[c] = sumTT;
    block.tr[c] = sumTR;
    block.rt[c] = sumRT;
    block.rr[c] = sumRR;
  }
  return block;
}

// Inertia, air, grabs, the collider that is touched, and seams as if what they are sewn to stood still.
void addParticle(uint i, Hanging hanging) {
  float diagonal = texelFetch(rightHandSides, int(i)).w;
  precise float stiffness = diagonal;
  if (hasWind) {
    vec3 air = airBlockAt(i).diagonal;
    stiffness = stiffness + uintBitsToFloat(0x3eaaaaabu) * ((air.x + air.y) + air.z);
  }
#if HAS_SEAMS
  uvec2 seams = seamsOf(i);
  for (uint n = seams.x; n < seams.y; ++n) stiffness = stiffness + seamSpring(n).stiffness;
#endif
  addIsotropic(stiffness, hanging);
  if (hasContacts) addPulling(contactStiffness(diagonal), contactPlaneAt(i).xyz, hanging);
#if HAS_SURFACE
  uvec2 range = pairsOf(i);
  for (uint k = range.x; k < range.y; ++k) {
    uint entry = pairEntry(k), q = entry / 4u;
    float weight = pairRow(q, 1u)[entry % 4u], held = pairRow(q, 2u).w;
    precise float stiffness = (weight * weight) * held;
    if (held > 0.0) addPulling(stiffness, pairRow(q, 0u).xyz, hanging);
  }
#endif
}

void addSpring(uint i, vec4 x, Hanging hanging, IncidentSpring spring) {
  vec4 other = iterateAt(spring.other);
  Hanging end = hangingOf(spring.other, other);
  precise vec3 d = other.xyz - x.xyz;
  precise vec3 atStart = positionAt(spring.other).xyz - positionAt(i).xyz;
  float along = springBlock(d, spring, false).along, across = springBlock(atStart, spring, false).across;
  precise vec4 row = end.row - hanging.row;
  precise vec4 column = end.column - hanging.column;
  bool isRigid = isOfAll && x.w > 0.0 && other.w > 0.0;
  if (!isRigid) addPulling(along, d, Hanging(row, column));
  if (across > 0.0) addIsotropic(across, Hanging(row, column));
}

#if HAS_MESH
Hanging difference(Hanging to, Hanging from) {
  precise vec4 row = to.row - from.row;
  precise vec4 column = to.column - from.column;
  return Hanging(row, column);
}

// The force of a row of R, whose entries are `scales`, on a body on which edges d hang by `levers`.
RigidVector pullOfEdges(vec3 scales, vec3 d[3], vec4 levers[3]) {
  RigidVector x = pullOf(levers[0], d[0]), y = pullOf(levers[1], d[1]), z = pullOf(levers[2], d[2]);
  precise vec3 force = (scales.x * x.translation + scales.y * y.translation) + scales.z * z.translation;
  precise vec3 torque = (scales.x * x.rotation + scales.y * y.rotation) + scales.z * z.rotation;
  return RigidVector(force, torque);
}
void addEdgesElement(vec3 scales, vec3 d[3], vec4 rows[3], vec4 columns[3]) {
  addOuter(pullOfEdges(scales, d, rows), pullOfEdges(scales, d, columns));
}

// Of its first corner, which is at x.
void addMembrane(vec4 x, Hanging first, Membrane m) {
  vec4 second = iterateAt(m.corners.y), third = iterateAt(m.corners.z);
  Hanging b = hangingOf(m.corners.y, second), c = hangingOf(m.corners.z, third);
  Hanging edges[3] = Hanging[3](difference(c, b), difference(first, c), difference(b, first));
  vec3 d[3] = edgesOf(x.xyz, second.xyz, third.xyz);
  vec4 rows[3] = vec4[3](edges[0].row, edges[1].row, edges[2].row),
       columns[3] = vec4[3](edges[0].column, edges[1].column, edges[2].column);
  bool isRigid = isOfAll && x.w > 0.0 && second.w > 0.0 && third.w > 0.0;
  if (!isRigid) {
    addEdgesElement(m.first, d, rows, columns);
    addEdgesElement(vec3(0.0, m.second), d, rows, columns);
    addEdgesElement(vec3(0.0, 0.0, m.third), d, rows, columns);
  }
  uvec3 at = m.corners;
  vec3 tensions = positiveTensions(m, edgesOf(positionAt(at.x).xyz, positionAt(at.y).xyz, positionAt(at.z).xyz));
  for (int k = 0; k < 3; ++k)
    if (tensions[k] != 0.0) addIsotropic(tensions[k], edges[k]);
}

void addElementsOf(uint i) {
  vec4 x = iterateAt(i);
  Hanging hanging = hangingOf(i, x);
  addParticle(i, hanging);
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    if (spring.other < i && pulls(spring)) addSpring(i, x, hanging, spring);
  }
  for (uint n = first.y; n < end.y; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    if (number % 4u != 0u) continue;
    Hinge hinge = hingeAt(number);
    precise vec4 row = vec4(0.0);
    precise vec4 column = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
      Hanging corner = hangingOf(hinge.corners[k]);
      row = row + hinge.coefficients[k] * corner.row;
      column = column + hinge.coefficients[k] * corner.column;
    }
    addIsotropic(1.0, Hanging(row, column));
  }
  for (uint n = first.w; n < end.w; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    if (number % 4u == 0u) addMembrane(x, hanging, membraneAt(number));
  }
}
#else
void addLine(uint i, uint stride, Hanging middle, float b) {
  bool endOfClamp = iterateAt(i).w == 0.0 && (iterateAt(i - stride).w == 0.0) != (iterateAt(i + stride).w == 0.0);
  Hanging before = hangingOf(i - stride), behind = hangingOf(i + stride);
  precise float weighted = endOfClamp ? 2.0 * b : b;
  precise vec4 row = (before.row - middle.row) + (behind.row - middle.row);
  precise vec4 column = (before.column - middle.column) + (behind.column - middle.column);
  addIsotropic(weighted, Hanging(row, column));
}

void addElementsOf(uint i) {
  uint place = i - step.firstParticle;
  GridPoint p = GridPoint(place % step.columns, place / step.columns, i, true);
  vec4 x = iterateAt(i);
  Hanging hanging = hangingOf(i, x);
  addParticle(i, hanging);
  uint cut = cutMaskOf(i);
  for (uint k = 0u; k < OWNED_SPRINGS; ++k) {
    IncidentSpring spring = incidentSpring(p, k, cut);
    if (spring.exists) addSpring(i, x, hanging, spring);
  }
  if (!hasMaterial) return;
  bool borderRow = p.row == 0u || p.row + 1u == step.rows;
  bool borderColumn = p.column == 0u || p.column + 1u == step.columns;
  precise float alongRow = borderRow ? 0.5 * step.bendAlongRow : step.bendAlongRow;
  precise float alongColumn = borderColumn ? 0.5 * step.bendAlongColumn : step.bendAlongColumn;
  if (!borderColumn && (cut & BENDING_ROW) == 0u) addLine(i, 1u, hanging, alongRow);
  if (!borderRow && (cut & BENDING_COLUMN) == 0u) addLine(i, step.columns, hanging, alongColumn);
}
#endif

void main() {
  if (isSkipped()) return;
  uint i = thisEntry();
  if (!isEntry(i, level.endBlock - level.firstBlock)) return;
  uint number = level.firstBlock + i;
  uvec4 block = texelFetch(coarsePairs, int(number));
  pair = block.xy;
  rowCenter = centerAt(pair.x);
  isOfAll = pair.y == ALL_VERTICES;
  columnCenter = centerAt(isOfAll ? pair.x : pair.y);
  for (uint k = block.z; k < block.w; ++k) addElementsOf(texelFetch(coarseSources, int(k)).x);
  storeBlock(blockOfSums(), number, pair);
}
