// The start of a search: its state; the boxes around the motions of triangles, and around each four of them; the sides of blocks;
// and what the search counts up for particles. Work groups take one of these each, in this order. LATER: of a round that goes
// on from where motion was cut short, if there was any. ONLY_BOXES: those of triangles once more, after corrections.
#define IS_START 1
#include "sim/surface/common.glsl"
#include "sim/surface/flat_sides.glsl"

layout(local_size_x = SURFACE_GROUP) in;

layout(std430, binding = WATCH_BINDING) readonly buffer Watch { uint watchRow[PASSES]; };
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Boxes { vec4 newBoxes[]; };
#if SEARCHES_TOUCHING
layout(std430, binding = SURFACE_LISTS_BINDING) writeonly buffer ListCounts { uint listCounts[]; };
layout(std430, binding = SURFACE_COUNTS_BINDING) writeonly buffer Cursors { uint cursors[]; };
#else
layout(std430, binding = SURFACE_LISTS_BINDING) writeonly buffer Corrections { ivec4 corrections[]; };
layout(std430, binding = SURFACE_COUNTS_BINDING) writeonly buffer Kept { uint kept[]; };
#endif

void clear(uint i) {
#if SEARCHES_TOUCHING
  listCounts[i] = 0u;
  cursors[i] = 0u;
#else
  kept[i] = floatBitsToUint(1.0);
  kept[step.totalParticles + i] = floatBitsToUint(1.0);
  corrections[i] = ivec4(0);
#endif
}

// Nothing that this dispatch reads.
void begin() {
#if SEARCHES_TOUCHING
#if !LATER
  state.isLater = 0u;
  state.isSettled = 0u;
  state.isPressed = 0u;
  state.keptPairs = state.pairs;
#endif
  state.tooMany = 0u;
#else
  for (uint round = 0u; round < uint(GUARD_ROUNDS); ++round) state.tooNear[round] = 0u;
  state.isGuarded = 0u;
  state.wasPushedFar = 0u;
#endif
  state.isFlat = 0u;
  for (uint pass = 0u; pass < uint(PASSES); ++pass)
    if (watchRow[pass] != NO_DIVERGENCE) state.tooMany = 2u;
}

void store(uint box, MovingBounds bounds) {
  vec4 rows[3] = rowsOf(bounds);
  for (uint k = 0u; k < 3u; ++k) newBoxes[3u * box + k] = rows[k];
}

// The boxes of some triangles, and the one of the next level around them.
void boxTriangles(uint parent) {
  uint first = BOX_CHILDREN * parent;
  MovingBounds whole;
  for (uint k = 0u; k < BOX_CHILDREN && first + k < surface.triangles; ++k) {
    uvec4 corners = texelFetch(triangles, int(2u * (first + k)));
    MovingBounds box = joined(joined(boxOf(corners.x), boxOf(corners.y)), boxOf(corners.z));
    store(first + k, box);
    whole = k == 0u ? box : joined(whole, box);
  }
  if (surface.topLevel > 0) store(surface.firstBoxes[1].x + parent, whole);
}

uint groupsFor(uint entries) { return (entries + uint(SURFACE_GROUP) - 1u) / uint(SURFACE_GROUP); }

void main() {
  if (isSettled()) return;
#if ONLY_BOXES
  if (state.tooNear[0] == 0u) return;  // nobody looks at them
#else
  if (thisEntry() == 0u) begin();
#endif
  uint group = thisEntry() / uint(SURFACE_GROUP), lane = gl_LocalInvocationIndex;
  bool searches = surface.touchesItself != 0u;
  uint parents = searches ? (surface.triangles + BOX_CHILDREN - 1u) / BOX_CHILDREN : 0u, blocks = searches ? surface.blocks : 0u;
  uint entry = group * uint(SURFACE_GROUP) + lane;
  if (group < groupsFor(parents)) {
    if (entry < parents) boxTriangles(entry);
    return;
  }
  entry -= groupsFor(parents) * uint(SURFACE_GROUP);
  if (entry < groupsFor(blocks) * uint(SURFACE_GROUP)) {
    if (entry < blocks) findSides(entry);
    return;
  }
  entry -= groupsFor(blocks) * uint(SURFACE_GROUP);
  if (entry < step.totalParticles) clear(entry);
}
