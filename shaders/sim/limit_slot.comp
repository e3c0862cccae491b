// Limit on grids: both colours of a slot in one dispatch. Springs of a slot make lines of grid points; of four points in
// a row, the first colour has the outer springs and the second the middle one. Whoever stores the middle points limits
// all three springs, of which neighbours limit the outer ones again. They read where points were before, so the new
// positions go into another buffer.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/limit.glsl"

layout(std140, binding = LIMIT_COLOR_BINDING) uniform ColorBlock { LimitColor color; };

struct Point {
  bool exists;
  uint index;  // that of some particle when it does not exist
};

// Four points in a row, the first at the owner of a spring, and what is known of their three springs.
struct Line {
  Point points[4];
  bool exists[3];
};

Point pointAt(ivec2 place) {
  bool exists = place.x >= 0 && place.y >= 0 && place.x < int(step.columns) && place.y < int(step.rows);
  uint inGrid = exists ? uint(place.y) * step.columns + uint(place.x) : 0u;
  return Point(exists, step.firstParticle + inGrid);
}

bool hasSpring(Point owner, Point other) {
  return owner.exists && other.exists && isIntact(cutMaskOf(owner.index), color.slot);
}

// The n-th of 0 2 4 6 for a reach of one cell, of 0 1 4 5 for two.
int ownerOfSecondColor(uint n, uint reach) { return int(reach == 1u ? 2u * n : 4u * (n / 2u) + n % 2u); }

// The invocation's line in this row of invocations. A diagonal that leaves the grid at its left or right border goes
// on at the other one, without a spring: so all points are in the middle of some line.
Line lineIn(uint row) {
  ivec2 toOther = toOtherEnd[color.slot];
  bool diagonal = toOther.x != 0 && toOther.y != 0;
  uint column = gl_GlobalInvocationID.x;
  ivec2 second = toOther.y == 0 ? ivec2(ownerOfSecondColor(column, uint(-toOther.x)), row)
                                : ivec2(column, ownerOfSecondColor(row, uint(-toOther.y)));
  ivec2 third = second + toOther;
  bool leaves = diagonal && (third.x < 0 || third.x >= int(step.columns));
  if (leaves) third.x += third.x < 0 ? int(step.columns) : -int(step.columns);
  Line line;
  line.points = Point[4](pointAt(second - toOther), pointAt(second), pointAt(third), pointAt(third + toOther));
  line.exists = bool[3](hasSpring(line.points[0], line.points[1]), hasSpring(line.points[1], line.points[2]) && !leaves,
                        hasSpring(line.points[2], line.points[3]));
  return line;
}

SpringEnd endAt(Point point) {
  return SpringEnd(texelFetch(positionsSoFar, int(point.index)), vec3(0.0), false);
}
SpringEnd endWithVelocityAt(Point point) {
  SpringEnd end = endAt(point);
  end.velocity = texelFetch(velocitiesSoFar, int(point.index)).xyz;
  return end;
}

bool isTooLong(Line line, int spring, SpringEnd a, SpringEnd b) {
  float limit = longestOf(color.slot, line.points[spring].index);
  return line.exists[spring] && isTooLong(a.position.xyz, b.position.xyz, limit);
}

// Stores the middle points where no spring is too long, and returns whether one is.
bool isSomeTooLong(Line line) {
  SpringEnd first = endAt(line.points[0]), a = endAt(line.points[1]), b = endAt(line.points[2]), last = endAt(line.points[3]);
  bool some = isTooLong(line, 0, first, a) || isTooLong(line, 1, a, b) || isTooLong(line, 2, b, last);
  if (line.points[1].exists && !some) newPositions[line.points[1].index] = a.position;
  if (line.points[2].exists && !some) newPositions[line.points[2].index] = b.position;
  return some;
}

void limit(Line line, int spring, inout SpringEnd a, inout SpringEnd b) {
  if (line.exists[spring]) limitSpring(a, b, longestOf(color.slot, line.points[spring].index));
}

void store(Point point, SpringEnd end) {
  if (!point.exists) return;
  newPositions[point.index] = end.position;
  if (end.moved) newVelocities[point.index] = vec4(end.velocity, 0.0);
}

void limitLine(Line line) {
  SpringEnd first = endAt(line.points[0]), a = endWithVelocityAt(line.points[1]), b = endWithVelocityAt(line.points[2]),
            last = endAt(line.points[3]);
  limit(line, 0, first, a);
  limit(line, 2, b, last);
  limit(line, 1, a, b);
  store(line.points[1], a);
  store(line.points[2], b);
}

// An invocation looks at a few lines before it limits those that need it: on drivers that run both sides of a branch
// only a loop can be left early.
void main() {
  if (toOtherEnd[color.slot].y != 0 && gl_GlobalInvocationID.x >= step.columns) return;
  uint firstRow = gl_GlobalInvocationID.y * LINES_AT_ONCE;
  uint tooLong = 0u;
  for (uint k = 0u; k < LINES_AT_ONCE; ++k)
    if (isSomeTooLong(lineIn(firstRow + k))) tooLong |= 1u << k;
  for (; tooLong != 0u; tooLong &= tooLong - 1u) limitLine(lineIn(firstRow + uint(findLSB(tooLong))));
}
