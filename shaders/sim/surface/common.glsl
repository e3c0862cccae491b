// What all passes of surface contact see (src/solver/surface.h says what is computed and why; the twins are
// src/solver/cpu/surface_search.h and surface_contact.cpp).
#include "shared/implicit.h"
#include "shared/step_params.h"
#include "shared/surface.h"
#include "sim/exact_math.glsl"
#ifndef IS_START
#define IS_START 0
#endif

layout(std140, binding = STEP_PARAMS_BINDING) uniform StepBlock { StepParams step; };
layout(std140, binding = SURFACE_PARAMS_BINDING) uniform SurfaceParamsBlock { SurfaceParams surface; };
layout(std430, binding = SURFACE_STATE_BINDING) coherent buffer State { SurfaceState state; };
layout(binding = SURFACE_TRIANGLES_UNIT) uniform usamplerBuffer triangles;
layout(binding = SURFACE_POINTS_UNIT) uniform samplerBuffer points;
layout(binding = SURFACE_BOXES_UNIT) uniform samplerBuffer boxes;
layout(binding = SURFACE_STARTS_UNIT) uniform samplerBuffer surfaceStarts;
layout(binding = NEW_POSITIONS_UNIT) uniform samplerBuffer positionsSoFar;
layout(binding = DISPLACEMENTS_UNIT) uniform samplerBuffer displacements;

#define LAW
#include "shared/surface_laws.h"

// Of the particles in the way between two parts.
vec4 weightsOf(bool areSides, NearestParts nearest) {
  precise float rest = 1.0 - nearest.u;
  precise float weightB = nearest.v - rest;
  precise float weightC = nearest.v - 1.0;
  vec4 weights = areSides ? vec4(rest, nearest.u, weightC, -nearest.v) : vec4(1.0, weightB, -nearest.u, -nearest.v);
  return vec4(canonical(weights.xyz), canonical(weights.w));
}

// From where the motion of this round begins.
vec3 startAt(uint i) { return texelFetch(surfaceStarts, int(i)).xyz; }

// Where nothing was cut short, the step does not go on. The start of a step finds the state of the one before.
#if IS_START && SEARCHES_TOUCHING && !LATER
bool isSettled() { return false; }
bool isLater() { return false; }
#else
bool isSettled() { return state.isSettled != 0u; }
bool isLater() { return state.isLater != 0u; }
#endif

// An invocation an entry, in groups of SURFACE_GROUP; dispatches of many groups have rows of GROUPS_A_ROW.
uint thisEntry() {
  return (gl_WorkGroupID.y * GROUPS_A_ROW + gl_WorkGroupID.x) * uint(SURFACE_GROUP) + gl_LocalInvocationIndex;
}

vec3 displacementAt(uint i) { return texelFetch(displacements, int(i)).xyz; }

// The motion of this round: as it is predicted, or what it came to.
vec3 motionAt(uint i) {
#if SEARCHES_TOUCHING
  return isLater() ? vec3(0.0) : displacementAt(i);
#else
  precise vec3 motion = texelFetch(positionsSoFar, int(i)).xyz - startAt(i);
  return motion;
#endif
}

struct Bounds {
  vec3 low, high;
};
float lesser(float s, float t) { return t < s ? t : s; }
float greater(float s, float t) { return s < t ? t : s; }
Bounds joined(Bounds a, Bounds b) {
  return Bounds(vec3(lesser(a.low.x, b.low.x), lesser(a.low.y, b.low.y), lesser(a.low.z, b.low.z)),
             vec3(greater(a.high.x, b.high.x), greater(a.high.y, b.high.y), greater(a.high.z, b.high.z)));
}
bool overlap(Bounds a, Bounds b) { return all(lessThanEqual(a.low, b.high)) && all(lessThanEqual(b.low, a.high)); }

// Around what moves linearly: at the start and at the end of its motion.
struct MovingBounds {
  Bounds start, end;
};
MovingBounds joined(MovingBounds a, MovingBounds b) { return MovingBounds(joined(a.start, b.start), joined(a.end, b.end)); }
// Whether anything of both may meet at the same time. What lies on one side of something at the start and at the end, does so on
// the whole way.
bool isNotAbove(MovingBounds a, MovingBounds b) {
  bvec3 atStart = lessThanEqual(a.start.low, b.start.high), atEnd = lessThanEqual(a.end.low, b.end.high);
  return (atStart.x || atEnd.x) && (atStart.y || atEnd.y) && (atStart.z || atEnd.z);
}
bool overlap(MovingBounds a, MovingBounds b) { return isNotAbove(a, b) && isNotAbove(b, a); }
MovingBounds chosen(bool isFirst, MovingBounds a, MovingBounds b) {
  if (isFirst) return a;
  return b;
}
// What was held back may be anywhere on its way while others go on: then boxes are around all of it.
#ifndef HOLDS_BACK
#define HOLDS_BACK false
#endif
MovingBounds seen(MovingBounds box) {
  if (!HOLDS_BACK) return box;
  Bounds all = joined(box.start, box.end);
  return MovingBounds(all, all);
}

// As boxes are stored.
vec4[3] rowsOf(MovingBounds box) {
  return vec4[3](vec4(box.start.low, box.end.low.x), vec4(box.start.high, box.end.low.y), vec4(box.end.high, box.end.low.z));
}
MovingBounds boundsOf(vec4 a, vec4 b, vec4 c) { return MovingBounds(Bounds(a.xyz, b.xyz), Bounds(vec3(a.w, b.w, c.w), c.xyz)); }
MovingBounds boxAt(uint i) {
  int first = int(3u * i);
  return seen(boundsOf(texelFetch(boxes, first), texelFetch(boxes, first + 1), texelFetch(boxes, first + 2)));
}

// Around a particle and its motion.
MovingBounds boxOf(uint i) {
  vec3 a = startAt(i), r = vec3(SEARCHES_TOUCHING != 0 ? surface.around : surface.leastGap);
  precise vec3 b = a + motionAt(i);
  precise vec3 startLow = a - r;
  precise vec3 startHigh = a + r;
  precise vec3 endLow = b - r;
  precise vec3 endHigh = b + r;
  return seen(MovingBounds(Bounds(startLow, startHigh), Bounds(endLow, endHigh)));
}

// Which parts: the triangles that they are of, and the corner, or the sides, in them.
struct PartPlaces {
  uint first, second, k, l;
};
