// Particles on the edges of cuts, where the smooth surface has them: cuts go along the sides and diagonals of cells, and
// their steps are evened out by the two neighbours on the edge.
#include "shared/render_layout.h"

layout(local_size_x = SMOOTH_GROUP) in;
layout(std430, binding = NORMALS_POSITIONS_BINDING) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = CUT_CORNERS_BINDING) readonly buffer Corners { uvec4 corners[]; };  // before, here, after
layout(std430, binding = SMOOTH_POINTS_BINDING) writeonly buffer Moved { vec4 moved[]; };

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= uint(corners.length())) return;
  uvec4 corner = corners[at];
  moved[corner.y] = 0.25 * (positions[corner.x] + 2.0 * positions[corner.y] + positions[corner.z]);
}
