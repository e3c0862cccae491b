// Corrections of a level: its own, D^-1 r, and that of the next coarser one between its vertices. Pinned particles get 0.
#include "sim/implicit/level.glsl"

layout(std430, binding = CORRECTIONS_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

// Nothing across a cut.
vec3 from(uint vertex, bool isCut) { return isCut ? vec3(0.0) : texelFetch(corrections, int(vertex)).xyz; }

void main() {
  uvec2 fine = gl_GlobalInvocationID.xy;
  if (fine.x >= level.fineColumns || fine.y >= level.fineRows) return;
  uvec2 columns = coarsePlaces(fine.x, level.coarseColumns, level.fineColumns);
  uvec2 rows = level.coarseFirst + coarsePlaces(fine.y, level.coarseRows, level.fineRows) * level.coarseColumns;
  uint i = level.fineFirst + fine.y * level.fineColumns + fine.x, links = cutLinksOf(i);
  int across = columns.x == columns.y ? 0 : 1, along = rows.x == rows.y ? 0 : 1;
  vec3 upperLeft = from(rows.x + columns.x, (links & LINK_BIT(-across, -along)) != 0u);
  vec3 upperRight = from(rows.x + columns.y, (links & LINK_BIT(across, -along)) != 0u);
  vec3 lowerLeft = from(rows.y + columns.x, (links & LINK_BIT(-across, along)) != 0u);
  vec3 lowerRight = from(rows.y + columns.y, (links & LINK_BIT(across, along)) != 0u);
  precise vec3 around = 0.25 * ((upperLeft + upperRight) + (lowerLeft + lowerRight));
  precise vec3 correction = solveFor(factorsAt(i), texelFetch(residuals, int(i)).xyz) + around;
  bool pinned = i < step.totalParticles && iterateAt(i).w == 0.0;
  newCorrections[i] = vec4(pinned ? vec3(0.0) : canonical(correction), 0.0);
}
