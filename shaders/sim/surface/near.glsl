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

// Whether a triangle comes to where the surface turns within it. On flat parts particles are enough.
bool meetsEdge(ColliderParams collider, vec3 places[6], float reach) {
  vec3 normals[6];
  bool isNear = false, turns = false;
  for (int k = 0; k < 6; ++k) {
    Nearest nearest = nearestOnShape(collider, places[k]);
    normals[k] = nearest.normal;
    precise vec3 way = places[k % 3 + 3] - places[k % 3];
    precise float room = nearest.distance - reach;
    precise float roomSquared = room * room;
    isNear = isNear || room < 0.0 || roomSquared < sumOfProducts(way, way);
    for (int j = 0; j < k; ++j) turns = turns || sumOfProducts(normals[j], normals[k]) < SAME_FACE;
  }
  return isNear && turns;
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
    vec4 small = texelFetch(smallColliders, int(2u * s)), core = texelFetch(smallColliders, int(2u * s + 1u));
    ColliderParams collider = loadCollider(step.firstCollider + uint(small.x));
    vec3 end = pointOf(collider);
    vec3 begin = hasMovingColliders && collider.moving != 0u ? vec3(collider.pivotX, collider.pivotY, collider.pivotZ) : end;
    Bounds way = with(Bounds(begin, begin), end);
    if (!isNearWay(world, way.low, way.high, small.y)) continue;
    if (collider.type != COLLIDER_SPHERE) {
      vec3 places[6];
      for (int k = 0; k < 3; ++k) places[k] = startInFrame(collider, x[k]);
      for (int k = 3; k < 6; ++k) places[k] = placeInFrame(collider, x[k]);
      Bounds own = Bounds(places[0], places[0]);
      for (int k = 1; k < 6; ++k) own = with(own, places[k]);
      vec3 high = 0.0 < core.w ? vec3(core.w, core.y, core.w) : core.xyz;
      if (!isNearWay(own, -high, high, small.w)) continue;
      if (hasEdges(collider) && !meetsEdge(collider, places, small.w - small.z)) continue;
    }
    ++found;
#if WRITES_PAIRS
    uint q = firstFound + found - 1u;
    newIds[q] = uvec4(corners.xyz, corners.x);
    newRows[4u * q] = vec4(0.0);
    newRows[4u * q + 1u] = vec4(0.0);
    newRows[4u * q + 2u] = vec4(0.0, -float(s + 1u), LARGE_SQUARE, 0.0);
    newRows[4u * q + 3u] = vec4(0.0);
    newSlips[2u * q] = uvec4(uvec3(0u), firstPlace + s + 1u);
    for (int k = 0; k < 3; ++k) atomicAdd(listCounts[corners[k]], 1u);
    atomicAdd(listCounts[corners.x], 1u);
#endif
  }
}
