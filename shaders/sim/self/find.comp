// The candidates of every particle: non-adjacent particles within the search radius when hashed. Who has more than can be remembered says so
// and walks through the cells.
#include "sim/blocks.glsl"
#include "sim/exact_math.glsl"
#include "sim/self/common.glsl"
#include "sim/self/cells.glsl"

layout(std430, binding = CANDIDATES_BINDING) writeonly buffer Candidates { uint found[]; };

void main() {
  GridPoint p = thisGridPoint();
  if (!p.exists) return;
  vec3 x = texelFetch(hashedPositions, int(p.index)).xyz;
  ivec3 cell = cellOf(x);
  uint count = 0u;
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
      if (candidate == EXCLUDED) continue;
      if (count < MOST_CANDIDATES) found[count * self.particles + p.index] = candidate;
      ++count;
    }
  }
  found[MOST_CANDIDATES * self.particles + p.index] = count;
}
