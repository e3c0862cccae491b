// Corrections of a level: its own, D^-1 r, and that of the next coarser one between its vertices. Pinned particles get 0.
#include "sim/implicit/level.glsl"

layout(std430, binding = FIRST_OUTPUT_BINDING) writeonly buffer Corrections { vec4 newCorrections[]; };

void main() {
  uvec2 fine = gl_GlobalInvocationID.xy;
  if (fine.x >= level.fineColumns || fine.y >= level.fineRows) return;
  uvec2 columns = coarsePlaces(fine.x, level.coarseColumns, level.fineColumns);
  uvec2 rows = level.coarseFirst + coarsePlaces(fine.y, level.coarseRows, level.fineRows) * level.coarseColumns;
  vec3 upperLeft = texelFetch(corrections, int(rows.x + columns.x)).xyz, upperRight = texelFetch(corrections, int(rows.x + columns.y)).xyz;
  vec3 lowerLeft = texelFetch(corrections, int(rows.y + columns.x)).xyz, lowerRight = texelFetch(corrections, int(rows.y + columns.y)).xyz;
  precise vec3 around = 0.25 * ((upperLeft + upperRight) + (lowerLeft + lowerRight));
  uint i = level.fineFirst + fine.y * level.fineColumns + fine.x;
  precise vec3 correction = solveFor(factorsAt(i), texelFetch(residuals, int(i)).xyz) + around;
  bool pinned = i < step.totalParticles && iterateAt(i).w == 0.0;
  newCorrections[i] = vec4(pinned ? vec3(0.0) : canonical(correction), 0.0);
}
