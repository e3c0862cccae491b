// Forces on the particles of meshes, gathered over lists in ascending order (src/solver/mesh_lists.h); the twin is
// src/solver/cpu/mesh_forces.cpp.
#include "shared/mesh_lists.h"

layout(binding = LIST_STARTS_UNIT) uniform usamplerBuffer listStarts;
layout(binding = MESH_SPRINGS_UNIT) uniform usamplerBuffer meshSprings;
layout(binding = MESH_NUMBERS_UNIT) uniform usamplerBuffer meshNumbers;
layout(binding = HINGES_UNIT) uniform usamplerBuffer hinges;
layout(binding = MESH_TRIANGLES_UNIT) uniform usamplerBuffer meshTriangles;
#include "sim/membrane.glsl"

// Every spring is watched once, at its owner.
vec3 gatherMeshSprings(uint i, uint first, uint end) {
  vec3 x = positionAt(i).xyz;
  bool tooLong = false;
  precise vec3 f = vec3(0.0);
  for (uint n = first; n < end; ++n) {
    uvec4 spring = texelFetch(meshSprings, int(n));
    float rest = uintBitsToFloat(spring.w);
    vec3 other = positionAt(spring.x).xyz;
    precise vec3 d = other - x;
    precise float lengthSquared = sumOfProducts(d, d);
    precise float longest = step.maxStretch * rest;
    precise float longestSquared = longest * longest;
    tooLong = tooLong || (spring.x < i && isBeyond(lengthSquared, longestSquared));
    if (uintBitsToFloat(spring.z) != 0.0) f = f + springForce(x, other, uintBitsToFloat(spring.z), rest);
    if (hasLimitSprings) {
      precise float inverseLength = inverseSquareRoot(lengthSquared);
      precise float over = lengthSquared * inverseLength - step.limitFactor * rest;
      precise float scale = (step.limitStiffness * over) * inverseLength;
      precise vec3 pull = scale * d;
      if (over > 0.0) f = f + pull;
    }
  }
  if (tooLong) noteDivergence(PASS_FORCES, i, REASON_RUNAWAY_STRAIN);
  return f;
}

// -c_i sum c_j (x_j - x_0): the differences are small, and the c sum to 0.
vec3 addHinges(uint first, uint end, vec3 force) {
  precise vec3 f = force;
  for (uint n = first; n < end; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    int row = int(number / 4u) * HINGE_ROWS;
    uvec4 corners = texelFetch(hinges, row);
    vec4 c = uintBitsToFloat(texelFetch(hinges, row + 1));
    vec3 origin = positionAt(corners.x).xyz;
    precise vec3 b = c.y * (positionAt(corners.y).xyz - origin);
    precise vec3 p = c.z * (positionAt(corners.z).xyz - origin);
    precise vec3 q = c.w * (positionAt(corners.w).xyz - origin);
    precise vec3 bent = (b + p) + q;
    f = f - c[number % 4u] * bent;
  }
  return f;
}

vec3 addMembranes(uint first, uint end, vec3 force) {
  precise vec3 f = force;
  for (uint n = first; n < end; ++n) {
    uint number = texelFetch(meshNumbers, int(n)).x;
    Membrane membrane = membraneAt(number);
    uvec3 at = membrane.corners;
    vec3 d[3] = edgesOf(positionAt(at.x).xyz, positionAt(at.y).xyz, positionAt(at.z).xyz);
    vec3 tensions = timesMatrix(membrane, strainsOf(membrane, d));
    precise vec3 x = tensions.x * d[0];
    precise vec3 y = tensions.y * d[1];
    precise vec3 z = tensions.z * d[2];
    f = f + pullAt(number % 4u, vec3[3](x, y, z));
  }
  return f;
}

vec3 addMeshTriangles(uint first, uint end, vec3 force) {
  precise vec3 f = force;
  for (uint n = first; n < end; ++n) {
    uvec4 corners = texelFetch(meshTriangles, int(texelFetch(meshNumbers, int(n)).x));
    f = f + windForce(corners.x, corners.y, corners.z);
  }
  return f;
}

vec3 gatherMeshForces(uint i) {
  uvec4 first = texelFetch(listStarts, int(i)), end = texelFetch(listStarts, int(i) + 1);
  vec3 f = gatherMeshSprings(i, first.x, end.x);
  f = addHinges(first.y, end.y, f);
  f = addMembranes(first.w, end.w, f);
  if (hasWind) f = addMeshTriangles(first.z, end.z, f);
  return f;
}
