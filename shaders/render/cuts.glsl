// Which triangles of a grid are left after cuts (cloth/cuts.h). Before the include: `isOnGrid` and `particleAt`.
// The slots are those of SpringSlot.
const uint TO_LEFT = 0u, TO_UPPER = 1u, TO_UPPER_LEFT = 2u, TO_UPPER_RIGHT = 3u, TO_SECOND_LEFT = 4u, TO_SECOND_UPPER = 5u;

#ifdef CUTS
layout(std430, binding = CUTS_BINDING) readonly buffer Cuts { uint cuts[]; };
bool isCut(ivec2 owner, uint slot) { return isOnGrid(owner) && (cuts[particleAt(owner)] >> slot & 1u) != 0u; }
#else
bool isCut(ivec2 owner, uint slot) { return false; }
#endif

// Of the cell whose corners are A B / C D, with A at `a`: whether its triangle (A, C, B), or (B, C, D), is there.
bool hasUpperTriangle(ivec2 a) {
  ivec2 b = a + ivec2(1, 0), c = a + ivec2(0, 1);
  return !isCut(c, TO_UPPER_RIGHT) && !isCut(c, TO_UPPER) && !isCut(b, TO_LEFT);
}
bool hasLowerTriangle(ivec2 a) {
  ivec2 c = a + ivec2(0, 1), d = a + ivec2(1, 1);
  return !isCut(c, TO_UPPER_RIGHT) && !isCut(d, TO_LEFT) && !isCut(d, TO_UPPER);
}
