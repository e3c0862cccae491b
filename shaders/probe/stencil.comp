// A particle and the twelve that its springs lead to, added up: the memory traffic of a step without its arithmetic.
// LOADS: 0 texels of a buffer texture, 1 a storage block, 2 a storage block by way of a tile in shared memory.
// The grid is a power of two wide, and neighbours across its border are those at the other side.
layout(local_size_x = GROUP_COLUMNS, local_size_y = GROUP_ROWS) in;
layout(std430, binding = 1) writeonly restrict buffer Sums { vec4 sums[]; };
#if LOADS == 0
layout(binding = 0) uniform samplerBuffer points;
vec4 load(uvec2 at) { return texelFetch(points, int((at.y & (SIZE - 1u)) * SIZE + (at.x & (SIZE - 1u)))); }
#else
layout(std430, binding = 0) readonly restrict buffer Points { vec4 points[]; };
vec4 load(uvec2 at) { return points[(at.y & (SIZE - 1u)) * SIZE + (at.x & (SIZE - 1u))]; }
#endif

#if LOADS == 2
const uint HALO = 2u, TILE_COLUMNS = GROUP_COLUMNS + 2u * HALO, TILE_ROWS = GROUP_ROWS + 2u * HALO;
shared vec4 tile[TILE_ROWS * TILE_COLUMNS];

void fillTile() {
  uvec2 corner = gl_WorkGroupID.xy * gl_WorkGroupSize.xy - HALO;
  for (uint k = gl_LocalInvocationIndex; k < TILE_ROWS * TILE_COLUMNS; k += GROUP_COLUMNS * GROUP_ROWS)
    tile[k] = load(corner + uvec2(k % TILE_COLUMNS, k / TILE_COLUMNS));
  memoryBarrierShared();
  barrier();
}
vec4 at(int columns, int rows) {
  ivec2 place = ivec2(gl_LocalInvocationID.xy) + int(HALO) + ivec2(columns, rows);
  return tile[uint(place.y) * TILE_COLUMNS + uint(place.x)];
}
#else
void fillTile() {}
vec4 at(int columns, int rows) { return load(uvec2(ivec2(gl_GlobalInvocationID.xy) + ivec2(columns, rows))); }
#endif

void main() {
  fillTile();
  vec4 sum = at(0, 0);
  sum += at(-1, 0) + at(1, 0) + at(0, -1) + at(0, 1);
  sum += at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1);
  sum += at(-2, 0) + at(2, 0) + at(0, -2) + at(0, 2);
  uvec2 own = gl_GlobalInvocationID.xy;
  sums[own.y * SIZE + own.x] = sum;
}
