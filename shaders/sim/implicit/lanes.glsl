// Two values become one: their sum; of updates the larger one.
vec4 joined(vec4 a, vec4 b) {
#if SUM_KIND == SUM_UPDATE
  return vec4(a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, 0.0, 0.0);
#else
  precise vec4 sum = a + b;
  return sum;
#endif
}

// Joins what the lanes of a work group hold as a tree; lane 0 gets the result.
shared vec4 laneSums[SUM_LANES];

vec4 addLanes(vec4 own) {
  uint lane = gl_LocalInvocationID.x;
  laneSums[lane] = own;
  barrier();
  for (uint stride = uint(SUM_LANES) / 2u; stride > 0u; stride /= 2u) {
    if (lane < stride) laneSums[lane] = joined(laneSums[lane], laneSums[lane + stride]);
    barrier();
  }
  return laneSums[0];
}
