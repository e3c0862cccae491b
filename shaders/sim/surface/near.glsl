// The small colliders that are near the way of a triangle in the step; the twin is in src/solver/cpu/small_colliders.cpp.
layout(binding = COLLIDERS_UNIT) uniform samplerBuffer colliderRows;
layout(binding = DISTANCES_UNIT) uniform samplerBuffer distances;
layout(binding = STARTS_UNIT) uniform samplerBuffer stepStarts;
layout(binding = SMALL_COLLIDERS_UNIT) uniform samplerBuffer smallColliders;
const uint colliderTypes = COLLIDER_TYPES;
const bool hasMovingColliders = HAS_MOVING_COLLIDERS != 0;
#include "sim/shapes.glsl"
#include "sim/collider_frames.glsl"

// Around the way of a triangle.
Bounds with(Bounds box, vec3 x) { return joined(box, Bounds(x, x)); }

bool isNearWay(Bounds box, vec3 low, vec3 high, float around) {
  precise vec3 from = box.low - vec3(around);
  precise vec3 to = box.high + vec3(around);
  return overlap(Bounds(from, to), Bounds(low, high));
}

void lookAtColliders(uint own) {
  uvec4 corners = texelFetch(triangles, int(2u * own));
  vec3 x[6];
  for (int k = 0; k < 3; ++k) {
    x[k] = texelFetch(stepStarts, int(corners[k])).xyz;
    precise vec3 moved = x[k] + displacementAt(corners[k]);
    x[3 + k] = moved;
  }
  Bounds world = Bounds(x[0], x[0]);
  for (int k = 1; k < 6; ++k) world = with(world, x[k]);
  for (uint s = 0u; s < surface.smallColliders; ++s) {
    vec4 small = texelFetch(smallColliders, int(2u * s));
    float near = texelFetch(smallColliders, int(2u * s + 1u)).x;
    ColliderParams collider = loadCollider(step.firstCollider + uint(small.x));
    vec3 end = pointOf(collider);
    vec3 begin = hasMovingColliders && collider.moving != 0u ? vec3(collider.pivotX, collider.pivotY, collider.pivotZ) : end;
    Bounds way = with(Bounds(begin, begin), end);
    if (!isNearWay(world, way.low, way.high, small.y)) continue;
    if (collider.type != COLLIDER_SPHERE) {
      vec3 first = startInFrame(collider, x[0]);
      Bounds own = Bounds(first, first);
      for (int k = 1; k < 3; ++k) own = with(own, startInFrame(collider, x[k]));
      for (int k = 3; k < 6; ++k) own = with(own, placeInFrame(collider, x[k]));
      vec3 high = vec3(0.0, small.w, 0.0);
      if (!isNearWay(own, -high, high, near)) continue;
    }
    ++found;
#if WRITES_PAIRS
    uint q = firstFound + found - 1u;
    newIds[q] = uvec4(corners.xyz, corners.x);
    newRows[4u * q] = vec4(0.0);
    newRows[4u * q + 1u] = vec4(0.0);
    newRows[4u * q + 2u] = vec4(0.0, -float(s + 1u), LARGE_SQUARE, 0.0);
    newRows[4u * q + 3u] = vec4(0.0);
    for (int k = 0; k < 3; ++k) atomicAdd(listCounts[corners[k]], 1u);
    atomicAdd(listCounts[corners.x], 1u);
#endif
  }
}
