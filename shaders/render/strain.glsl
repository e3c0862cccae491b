// How far the cloth is stretched at a particle. Before the include: what cuts.glsl asks for, and `placeOf`.
#ifdef STRAIN
layout(std430, binding = REST_POSITIONS_BINDING) readonly buffer RestPositions { vec4 restPositions[]; };

// l/L - 1 of the side or diagonal that `owner` has in `slot`, to the point at `offset` from it; -1 when there is none.
float strainOf(ivec2 owner, ivec2 offset, uint slot) {
  ivec2 other = owner + offset;
  if (!isOnGrid(owner) || !isOnGrid(other) || isCut(owner, slot)) return -1.0;
  uint a = particleAt(owner), b = particleAt(other);
  float rest = distance(restPositions[a].xyz, restPositions[b].xyz);
  return distance(placeOf(a), placeOf(b)) / max(rest, 1e-12) - 1.0;
}

// The largest of those around a particle.
float strainAt(ivec2 point, vec3 here) {
  const ivec2 left = ivec2(-1, 0), upper = ivec2(0, -1), upperLeft = ivec2(-1, -1), upperRight = ivec2(1, -1);
  float largest = max(strainOf(point, left, TO_LEFT), strainOf(point - left, left, TO_LEFT));
  largest = max(largest, max(strainOf(point, upper, TO_UPPER), strainOf(point - upper, upper, TO_UPPER)));
  largest = max(largest, max(strainOf(point, upperLeft, TO_UPPER_LEFT), strainOf(point - upperLeft, upperLeft, TO_UPPER_LEFT)));
  return max(largest, max(strainOf(point, upperRight, TO_UPPER_RIGHT), strainOf(point - upperRight, upperRight, TO_UPPER_RIGHT)));
}
#else
float strainAt(ivec2 point, vec3 here) { return 0.0; }
#endif
