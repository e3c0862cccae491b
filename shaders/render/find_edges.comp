// Which tiles of the canvas may have edges before the stage: an invocation a tile, which looks how far its pixels and those
// around it differ.
#include "shared/render_layout.h"

layout(binding = CANVAS_UNIT) uniform sampler2D canvas;
#include "render/edge_contrast.glsl"

layout(local_size_x = NORMALS_GROUP_SIZE, local_size_y = NORMALS_GROUP_SIZE) in;
layout(location = EDGE_TILES_UNIFORM) uniform ivec4 tiles;  // the first column and row, and those after the last
layout(std430, binding = EDGE_MIDDLES_BINDING) writeonly buffer Middles { vec2 middles[]; };  // [pixels]
layout(std430, binding = EDGE_COMMAND_BINDING) buffer Command { uint found, instances, first, baseInstance; };

void main() {
  ivec2 tile = tiles.xy + ivec2(gl_GlobalInvocationID.xy);
  ivec2 corner = min(tile * EDGE_TILE, ivec2(frame.pixels.xy) - EDGE_TILE);
  float least = 1.0, most = 0.0, alpha = 0.0;
  int rows = min(EDGE_TILE + 1, int(frame.pixels.x));  // which no compiler knows: unrolled it would be a long program
  for (int y = -1; y < rows; ++y)
    for (int x = -1; x <= EDGE_TILE; ++x) {
      vec4 color = canvasAt(corner + ivec2(x, y));
      float here = brightness(color.rgb);
      least = min(least, here);
      most = max(most, here);
      alpha = max(alpha, color.a);
    }
  bool isFound = isContrast(least, most) && isBeforeStage(vec4(alpha)) && all(lessThan(tile, tiles.zw));
  if (isFound) middles[atomicAdd(found, 1u)] = vec2(corner) + 0.5 * EDGE_TILE;
}
