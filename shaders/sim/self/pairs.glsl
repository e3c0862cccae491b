// What two particles do to each other, over all candidates of a particle. The including pass defines look(), which sees each.

float pairDistance(uint candidate) {
  if (SELF_NEAR_CODES == 0) return self.distance;
  return codeDistance(candidate >> CANDIDATE_BITS);
}

void lookAtCandidates(GridPoint p) {
  uint count = texelFetch(candidates, int(MOST_CANDIDATES * self.particles + p.index)).x;
  if (count <= MOST_CANDIDATES) {
    for (uint slot = 0u; slot < count; ++slot) look(p.index, texelFetch(candidates, int(slot * self.particles + p.index)).x);
    return;
  }
  vec3 x = texelFetch(hashedPositions, int(p.index)).xyz;
  ivec3 cell = cellOf(x);
  for (int k = 0; k < 9; ++k) {
    Run run = runOf(cell, k);
    uint entries = run.end - run.first + run.secondEnd;
    for (uint n = 0u; n < entries; ++n) {
      uint e = run.first + n < run.end ? run.first + n : run.first + n - run.end;
      vec4 entry = texelFetch(sortedParticles, int(e));
      precise vec3 d = x - entry.xyz;
      precise float distanceSquared = sumOfProducts(d, d);
      uint j = unpackedIndex(entry.w);
      if (!(distanceSquared < self.searchSquared) || j == p.index || !isInRun(run, entry)) continue;
      uint candidate = encode(p, j);
      if (candidate != EXCLUDED) look(p.index, candidate);
    }
  }
}
