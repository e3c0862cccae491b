// Boxes around the motions of triangles: the lowest level of the tree.
#include "sim/surface/common.glsl"

layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = SURFACE_OUT_BINDING) writeonly buffer Boxes { vec4 newBoxes[]; };

void main() {
  uint i = thisEntry();
  if (i >= surface.triangles || isSettled()) return;
  uvec4 corners = texelFetch(triangles, int(2u * i));
  Bounds box = joined(joined(boxOf(corners.x), boxOf(corners.y)), boxOf(corners.z));
  newBoxes[2u * i] = vec4(box.low, 0.0);
  newBoxes[2u * i + 1u] = vec4(box.high, 0.0);
}
