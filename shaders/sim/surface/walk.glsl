// The walk of a triangle through the tree of boxes. Before the include: lookAt(), which sees the pairs of parts that it finds,
// where boxes meet, no particle is in both or sewn to one of the other, and the cloth is not flat; goesOn(), whether to go on looking; and looksAtFlat(),
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

// What is sewn together counts as one particle here.
uvec3 jointsOf(uint triangle, uvec4 corners) {
  if ((corners.w >> IS_SEWN & 1u) == 0u) return corners.xyz;
  return texelFetch(triangles, int(2u * surface.triangles + triangle)).xyz;
}

// A pair of parts of two triangles: its particles, and where they are.
struct Parts {
  bool mayMeet, areSides;
  uvec4 ids;
  PartPlaces places;
};
const uint CORNER_PAIRS = 6u, PART_PAIRS = 15u;

// Number n of them: the corners of the first triangle and the second one, the other way round, then two sides each.
Parts partsOf(uint n, uint first, uint second, MovingBounds boxOfFirst, MovingBounds boxOfSecond) {
  uvec4 mine = texelFetch(triangles, int(2u * first)), theirs = texelFetch(triangles, int(2u * second));
  uvec3 myJoints = jointsOf(first, mine), theirJoints = jointsOf(second, theirs);
  Parts parts;
  parts.areSides = n >= CORNER_PAIRS;
  if (parts.areSides) {
    uint k = (n - CORNER_PAIRS) / 3u, l = (n - CORNER_PAIRS) % 3u;
    parts.ids = uvec4(mine[k], mine[(k + 1u) % 3u], theirs[l], theirs[(l + 1u) % 3u]);
    parts.places = PartPlaces(first, second, k, l);
    bool own = (mine.w >> (uint(OWNED_SIDE) + k) & theirs.w >> (uint(OWNED_SIDE) + l) & 1u) != 0u;
    uvec2 a = uvec2(myJoints[k], myJoints[(k + 1u) % 3u]), b = uvec2(theirJoints[l], theirJoints[(l + 1u) % 3u]);
    parts.mayMeet = own && all(notEqual(a, b)) && all(notEqual(a, b.yx));
    if (!parts.mayMeet) return parts;
    MovingBounds box = joined(boxOf(parts.ids.x), boxOf(parts.ids.y));
    parts.mayMeet = overlap(box, boxOfSecond) && overlap(box, joined(boxOf(parts.ids.z), boxOf(parts.ids.w)));
  } else {
    bool isOfFirst = n < 3u;
    uint k = isOfFirst ? n : n - 3u;
    uvec4 from = isOfFirst ? mine : theirs, to = isOfFirst ? theirs : mine;
    parts.ids = uvec4(from[k], to.xyz);
    parts.places = PartPlaces(isOfFirst ? first : second, isOfFirst ? second : first, k, 0u);
    uvec3 others = isOfFirst ? theirJoints : myJoints;
    uint joint = isOfFirst ? myJoints[k] : theirJoints[k];
    parts.mayMeet = (from.w >> k & 1u) != 0u && all(notEqual(others, uvec3(joint)));
    if (!parts.mayMeet) return parts;
    parts.mayMeet = overlap(boxOf(from[k]), chosen(isOfFirst, boxOfSecond, boxOfFirst));
  }
  return parts;
}

// Where the walk of a triangle has come to: a box of a level, the triangle that it met last, and the next pair of their parts.
struct Walk {
  int level;
  uint place;  // within the level
  uint met, part;
  MovingBounds box;  // of the triangle that it met
};

// On to the next triangle behind this one, in the order of the tree, whose box meets; false at the end.
bool meetNext(uint own, MovingBounds ownBox, inout Walk walk) {
  for (;;) {
    for (; walk.place % BOX_CHILDREN == 0u && walk.level < surface.topLevel; ++walk.level) walk.place /= BOX_CHILDREN;
    for (;; walk.place *= BOX_CHILDREN, --walk.level) {  // down, as long as boxes meet
      uint first = surface.firstBoxes[walk.level].x;
      if (walk.place >= surface.firstBoxes[walk.level + 1].x - first) {
        if (walk.level == surface.topLevel) return false;
        walk.place = walk.place / BOX_CHILDREN + 1u;
        ++walk.level;
        break;
      }
      walk.box = boxAt(first + walk.place);
      bool meets = overlap(ownBox, walk.box);
      if (meets && walk.level > 0) continue;
      uint last = walk.place++;
      if (!meets || areFlat(own, last)) break;
      walk.met = last;
      walk.part = 0u;
      return true;
    }
  }
}

// On to the next pair of parts that may meet; false at the end.
bool findNext(uint own, MovingBounds ownBox, inout Walk walk, inout Parts parts) {
  do {
    while (walk.part < PART_PAIRS) {
      parts = partsOf(walk.part++, own, walk.met, ownBox, walk.box);
      if (parts.mayMeet) return true;
    }
  } while (meetNext(own, ownBox, walk));
  return false;
}

// Each invocation goes on until it has a pair to look at, then all look at theirs together: they would wait for each other at
// every pair of one of them (Aila and Laine 2009, "while-while"). One call: a driver may compile a copy for each.
void lookAround(uint own) {
  MovingBounds ownBox = boxAt(own);
  Walk walk = Walk(0, own + 1u, own, PART_PAIRS, ownBox);
  Parts parts;
  while (goesOn() && findNext(own, ownBox, walk, parts)) {
    uvec4 ids = parts.ids;
    lookAt(ids, parts.areSides, parts.places,
           nearestParts(parts.areSides, startAt(ids.x), startAt(ids.y), startAt(ids.z), startAt(ids.w)));
  }
}
