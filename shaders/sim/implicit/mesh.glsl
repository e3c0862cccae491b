// Springs, hinges and membranes of meshes in an implicit step; the twin of src/solver/cpu/mesh_implicit.cpp.
#include "shared/mesh_lists.h"
#include "sim/implicit/energy.glsl"

layout(binding = LIST_STARTS_UNIT) uniform usamplerBuffer listStarts;
layout(binding = MESH_SPRINGS_UNIT) uniform usamplerBuffer meshSprings;
layout(binding = MESH_NUMBERS_UNIT) uniform usamplerBuffer meshNumbers;
layout(binding = HINGES_UNIT) uniform usamplerBuffer hinges;
#include "sim/membrane.glsl"

// The n-th listed spring, of some particle.
IncidentSpring meshSpring(uint n) {
  uvec4 spring = texelFetch(meshSprings, int(n));
  float rest = uintBitsToFloat(spring.w);
  precise float limit = step.limitFactor * rest;
  return IncidentSpring(true, spring.x, uintBitsToFloat(spring.z), rest, limit);
}

struct Hinge {
  uvec4 corners;
  vec4 coefficients;
};
Hinge hingeAt(uint number) {
  int row = int(number / 4u) * HINGE_ROWS;
  return Hinge(texelFetch(hinges, row), uintBitsToFloat(texelFetch(hinges, row + 1)));
}
// sum c_j (v_j - v_0), the c of a hinge summing to 0
vec3 bentOf(vec4 c, vec3 v0, vec3 v1, vec3 v2, vec3 v3) {
  precise vec3 b = c.y * (v1 - v0);
  precise vec3 p = c.z * (v2 - v0);
  precise vec3 q = c.w * (v3 - v0);
  precise vec3 bent = (b + p) + q;
  return bent;
}

// Whether a spring does something: those along the edges of a membrane only limit.
bool pulls(IncidentSpring spring) { return hasLimitSprings || spring.stiffness != 0.0; }

vec3[3] iterateEdges(uvec3 at) { return edgesOf(iterateAt(at.x).xyz, iterateAt(at.y).xyz, iterateAt(at.z).xyz); }

// The tensions of the edges that meet at a corner, and of each row of R the force there.
Symmetric addBlockOf(Membrane m, uint corner, Symmetric block) {
  vec3 d[3] = iterateEdges(m.corners);
  vec3 t = positiveTensions(m, d);
  uint next = corner == 2u ? 0u : corner + 1u, last = corner == 0u ? 2u : corner - 1u;
  precise float across = t[last] + t[next];
  precise vec3 ax = m.first.x * d[0];
  precise vec3 ay = m.first.y * d[1];
  precise vec3 az = m.first.z * d[2];
  precise vec3 by = m.second.x * d[1];
  precise vec3 bz = m.second.y * d[2];
  precise vec3 cz = m.third * d[2];
  vec3 none = vec3(0.0);
  Symmetric own = sumOf(Symmetric(vec3(across), none), outerProduct3(1.0, pullAt(corner, vec3[3](ax, ay, az))));
  own = sumOf(own, outerProduct3(1.0, pullAt(corner, vec3[3](none, by, bz))));
  own = sumOf(own, outerProduct3(1.0, pullAt(corner, vec3[3](none, none, cz))));
  return sumOf(block, own);
}

// The force on a corner of a membrane whose corners move along the directions.
vec3 membraneProduct(Membrane m, uint corner, bool isExact) {
  uvec3 at = m.corners;
  vec3 d[3] = iterateEdges(at), e[3] = edgesOf(positionAt(at.x).xyz, positionAt(at.y).xyz, positionAt(at.z).xyz);
  vec3 t = isExact ? timesMatrix(m, strainsOf(m, d)) : positiveTensions(m, d);
  vec3 more = timesMatrix(m, vec3(sumOfProducts(d[0], e[0]), sumOfProducts(d[1], e[1]), sumOfProducts(d[2], e[2])));
  precise vec3 x = t.x * e[0] + more.x * d[0];
  precise vec3 y = t.y * e[1] + more.y * d[1];
  precise vec3 z = t.z * e[2] + more.z * d[2];
  return pullAt(corner, vec3[3](x, y, z));
}

// How a membrane's energy changes at the lengths tried.
vec4 addMembraneTrial(Membrane m, vec4 trial) {
  uvec3 at = m.corners;
  vec3 d[3] = iterateEdges(at), more[3] = edgesOf(incrementAt(at.x), incrementAt(at.y), incrementAt(at.z));
  vec3 w = timesRoots(m, strainsOf(m, d));
  vec3 slope = vec3(sumOfProducts(d[0], more[0]), sumOfProducts(d[1], more[1]), sumOfProducts(d[2], more[2]));
  vec3 second = vec3(sumOfProducts(more[0], more[0]), sumOfProducts(more[1], more[1]), sumOfProducts(more[2], more[2]));
  precise vec4 sum = trial;
  for (int k = 0; k < LENGTHS_TRIED; ++k) {
    float l = lengthsTried[k];
    precise vec3 change = l * (slope + (0.5 * l) * second);
    vec3 dw = timesRoots(m, change);
    precise vec3 part = dw * (w + 0.5 * dw);
    precise float all = (part.x + part.y) + part.z;
    sum[k] = sum[k] + all;
  }
  return sum;
}

Symmetric addMeshBlocks(uint i, Symmetric block) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz;
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    if (!pulls(spring)) continue;
    precise vec3 d = iterateAt(spring.other).xyz - x;
    SpringBlock s = springBlock(d, spring, false);
    Symmetric outer = outerProduct3(s.along, d);
    precise vec3 diagonal = outer.diagonal + vec3(s.across);
    block = sumOf(block, Symmetric(diagonal, outer.others));
  }
  for (uint n = first.y; n < end.y; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    float c = hingeAt(number).coefficients[number % 4u];
    precise float b = c * c;
    precise vec3 diagonal = block.diagonal + vec3(b);
    block.diagonal = diagonal;
  }
  for (uint n = first.w; n < end.w; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    block = addBlockOf(membraneAt(number), number % 4u, block);
  }
  return block;
}

// Minus H times the directions, as far as springs, hinges and membranes go. POSITIONS_UNIT: the directions.
vec3 meshProducts(uint i, bool isExact) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz, p = positionAt(i).xyz;
  precise vec3 force = vec3(0.0);
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    if (!pulls(spring)) continue;
    precise vec3 d = iterateAt(spring.other).xyz - x;
    SpringBlock s = springBlock(d, spring, isExact);
    precise vec3 e = positionAt(spring.other).xyz - p;
    precise vec3 f = s.across * e + (s.along * sumOfProducts(d, e)) * d;
    force = force + f;
  }
  for (uint n = first.y; n < end.y; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    Hinge hinge = hingeAt(number);
    vec3 bent = bentOf(hinge.coefficients, positionAt(hinge.corners.x).xyz, positionAt(hinge.corners.y).xyz,
                       positionAt(hinge.corners.z).xyz, positionAt(hinge.corners.w).xyz);
    force = force - hinge.coefficients[number % 4u] * bent;
  }
  for (uint n = first.w; n < end.w; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    force = force + membraneProduct(membraneAt(number), number % 4u, isExact);
  }
  return force;
}

// A spring belongs to its end of the larger index, a hinge or a membrane to its first corner.
vec4 addMeshTrials(uint i, vec4 trial) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz, own = incrementAt(i);
  precise vec4 sum = trial;
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    if (spring.other > i || !pulls(spring)) continue;
    precise vec3 d = iterateAt(spring.other).xyz - x;
    precise vec3 e = incrementAt(spring.other) - own;
    for (int k = 0; k < LENGTHS_TRIED; ++k) sum[k] = sum[k] + springChange(d, e, lengthsTried[k], spring);
  }
  for (uint n = first.y; n < end.y; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    if (number % 4u != 0u) continue;
    Hinge hinge = hingeAt(number);
    uvec4 at = hinge.corners;
    vec3 bent = bentOf(hinge.coefficients, iterateAt(at.x).xyz, iterateAt(at.y).xyz, iterateAt(at.z).xyz, iterateAt(at.w).xyz);
    vec3 more = bentOf(hinge.coefficients, incrementAt(at.x), incrementAt(at.y), incrementAt(at.z), incrementAt(at.w));
    precise float slope = sumOfProducts(bent, more);
    precise float second = sumOfProducts(more, more);
    sum = sum + lengthsTried * (slope + (0.5 * lengthsTried) * second);
  }
  for (uint n = first.w; n < end.w; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    if (number % 4u == 0u) sum = addMembraneTrial(membraneAt(number), sum);
  }
  return sum;
}
