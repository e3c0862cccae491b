// Springs and hinges of meshes in an implicit step; the twin of src/solver/cpu/mesh_implicit.cpp.
#include "shared/mesh_lists.h"
#include "sim/implicit/energy.glsl"

layout(binding = LIST_STARTS_UNIT) uniform usamplerBuffer listStarts;
layout(binding = MESH_SPRINGS_UNIT) uniform usamplerBuffer meshSprings;
layout(binding = MESH_NUMBERS_UNIT) uniform usamplerBuffer meshNumbers;
layout(binding = HINGES_UNIT) uniform usamplerBuffer hinges;

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

Symmetric addMeshBlocks(uint i, Symmetric block) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz;
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    precise vec3 d = iterateAt(spring.other).xyz - x;
    SpringBlock s = springBlock(d, spring);
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
  return block;
}

// Minus H times the directions, as far as springs and hinges go. POSITIONS_UNIT: the directions.
vec3 meshProducts(uint i) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz, p = positionAt(i).xyz;
  precise vec3 force = vec3(0.0);
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    precise vec3 d = iterateAt(spring.other).xyz - x;
    SpringBlock s = springBlock(d, spring);
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
  return force;
}

// A spring belongs to its end of the larger index, a hinge to its first corner.
vec4 addMeshTrials(uint i, vec4 trial) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 x = iterateAt(i).xyz, own = incrementAt(i);
  precise vec4 sum = trial;
  for (uint n = first.x; n < end.x; ++n) {
    IncidentSpring spring = meshSpring(n);
    if (spring.other > i) continue;
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
  return sum;
}
