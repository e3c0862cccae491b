// The work groups of a dispatch come to a point one after the other; the last one sees what the others have written to
// coherent blocks before. Needs sim/implicit/scalars.glsl.
shared bool isLast;

// For all invocations of a group; once a dispatch.
bool isLastGroup() {
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    isLast = atomicAdd(scalars.groupsDone, 1u) + 1u == gl_NumWorkGroups.x;
    if (isLast) scalars.groupsDone = 0u;
  }
  barrier();
  memoryBarrierBuffer();
  return isLast;
}
