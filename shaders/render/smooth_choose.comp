// Which points of the smooth surface its triangles need beside the particles: first those on the sides of cells, where a
// straight side would be seen beside the surface in the picture, above all at silhouettes; then those in the middle of cells
// (CENTERS), where a side needs its own or the diagonal would be seen. What is not needed goes to the place of a particle:
// from horizontal sides to the left, from vertical ones down, from the middle to the lower left. Triangles that have no area
// then leave each cell as two, or as a fan around its middle. A point is one and the same for all triangles, so that no gap
// opens.
#include "render/frame.glsl"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = SMOOTH_MIDDLES_BINDING) readonly buffer Middles { uint middles[]; };
layout(std430, binding = SMOOTH_POINTS_BINDING) readonly buffer Points { vec4 points[]; };
layout(std430, binding = SMOOTH_PLACES_BINDING) buffer Places { uint places[]; };

bool isSeen(uint middle, uint a, uint b) {
  vec4 clip = frame.clipFromWorld * vec4(points[middle].xyz, 1.0);
  if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(1.2 * clip.w)))) return false;  // outside of the picture
  vec4 straight = frame.clipFromWorld * vec4(0.5 * (points[a].xyz + points[b].xyz), 1.0);
  vec2 off = 0.5 * frame.pixels.xy * (clip.xy / clip.w - straight.xy / straight.w);
  return !(dot(off, off) <= frame.flatness * frame.flatness);
}

#ifdef CENTERS
const uint WORDS = 7u;
bool isNeeded(uint at) {
  for (uint side = at + 3u; side < at + WORDS; ++side)
    if (places[middles[side]] == middles[side]) return true;
  return isSeen(middles[at], middles[at + 1u], middles[at + 2u]);
}
#else
const uint WORDS = 3u;
bool isNeeded(uint at) { return isSeen(middles[at], middles[at + 1u], middles[at + 2u]); }
#endif

void main() {
  uint at = WORDS * gl_GlobalInvocationID.x;
  if (at >= uint(middles.length())) return;
  places[middles[at]] = isNeeded(at) ? middles[at] : middles[at + 1u];
}
