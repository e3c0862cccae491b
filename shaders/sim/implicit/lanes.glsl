// Adds what the lanes of a work group hold as a tree; lane 0 gets the sum.
shared vec4 laneSums[SUM_LANES];

vec4 addLanes(vec4 own) {
  uint lane = gl_LocalInvocationID.x;
  laneSums[lane] = own;
  barrier();
  for (uint stride = uint(SUM_LANES) / 2u; stride > 0u; stride /= 2u) {
    if (lane < stride) {
      precise vec4 sum = laneSums[lane] + laneSums[lane + stride];
      laneSums[lane] = sum;
    }
    barrier();
  }
  return laneSums[0];
}
