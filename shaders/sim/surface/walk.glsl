// The walk of a triangle through the tree of boxes. Before the include: lookAt(), which sees the pairs of parts that it finds,
// where boxes meet, no particle is in both, and the cloth is not flat; goesOn(), whether to go on looking; and looksAtFlat(),
// whether to look there, too.
layout(binding = FLAT_BLOCKS_UNIT) uniform usamplerBuffer blocksOfGrids;
layout(binding = FLAT_FLAGS_UNIT) uniform usamplerBuffer flatFlags;

// Whether both are in one block or in neighbours that are flat together.
bool areFlat(uint triangle, uint other) {
  if (looksAtFlat()) return false;
  uint block = texelFetch(triangles, int(2u * triangle + 1u)).w, second = texelFetch(triangles, int(2u * other + 1u)).w;
  if (block == NO_BLOCK || second == NO_BLOCK || texelFetch(flatFlags, int(block)).x == 0u) return false;
  uvec2 a = texelFetch(blocksOfGrids, int(3u * block + 1u)).xy, b = texelFetch(blocksOfGrids, int(3u * second + 1u)).xy;
  bool isOneGrid = texelFetch(blocksOfGrids, int(3u * block + 2u)).x == texelFetch(blocksOfGrids, int(3u * second + 2u)).x;
  return isOneGrid && all(lessThanEqual(a, b + uvec2(1u))) && all(lessThanEqual(b, a + uvec2(1u)));
}

void lookAtCorners(uint from, uint to, MovingBounds boxOfTo) {
  uvec4 mine = texelFetch(triangles, int(2u * from)), theirs = texelFetch(triangles, int(2u * to));
  for (uint k = 0u; k < 3u; ++k) {
    uint i = mine[k];
    if ((mine.w >> k & 1u) == 0u || i == theirs.x || i == theirs.y || i == theirs.z || !overlap(boxOf(i), boxOfTo)) continue;
    if (!goesOn()) return;
    NearestParts nearest = nearestOnTriangle(startAt(i), startAt(theirs.x), startAt(theirs.y), startAt(theirs.z));
    lookAt(uvec4(i, theirs.xyz), false, PartPlaces(from, to, k, 0u), nearest);
  }
}

void lookAtSides(uint from, uint to, MovingBounds boxOfTo) {
  uvec4 mine = texelFetch(triangles, int(2u * from)), theirs = texelFetch(triangles, int(2u * to));
  for (uint k = 0u; k < 3u; ++k) {
    if ((mine.w >> (uint(OWNED_SIDE) + k) & 1u) == 0u) continue;
    uint p = mine[k], q = mine[(k + 1u) % 3u];
    MovingBounds box = joined(boxOf(p), boxOf(q));
    if (!overlap(box, boxOfTo)) continue;
    for (uint l = 0u; l < 3u; ++l) {
      if ((theirs.w >> (uint(OWNED_SIDE) + l) & 1u) == 0u) continue;
      uint a = theirs[l], b = theirs[(l + 1u) % 3u];
      if (a == p || a == q || b == p || b == q || !overlap(box, joined(boxOf(a), boxOf(b)))) continue;
      if (!goesOn()) return;
      lookAt(uvec4(p, q, a, b), true, PartPlaces(from, to, k, l), nearestOnSegments(startAt(p), startAt(q), startAt(a), startAt(b)));
    }
  }
}

// The triangles behind this one, in the order of the tree.
void lookAround(uint own) {
  MovingBounds ownBox = boxAt(own);
  int level = 0;
  uint place = own + 1u;  // within the level
  for (;;) {
    for (; place % BOX_CHILDREN == 0u && level < surface.topLevel; ++level) place /= BOX_CHILDREN;
    bool isDone = false;
    for (;; place *= BOX_CHILDREN, --level) {  // down, as long as boxes meet
      uint first = surface.firstBoxes[level].x;
      if (place >= surface.firstBoxes[level + 1].x - first) {
        isDone = level == surface.topLevel;
        place = place / BOX_CHILDREN + 1u;
        ++level;
        break;
      }
      MovingBounds box = boxAt(first + place);
      bool meets = overlap(ownBox, box);
      if (meets && level > 0) continue;
      if (meets && !areFlat(own, place)) {
        for (int turn = 0; turn < 2; ++turn) {  // a driver compiles a loop once, but a copy for each call
          bool isFirst = turn == 0;
          lookAtCorners(isFirst ? own : place, isFirst ? place : own, chosen(isFirst, box, ownBox));
        }
        lookAtSides(own, place, box);
      }
      ++place;
      break;
    }
    if (isDone) break;
  }
}
