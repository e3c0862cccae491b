// The work groups of a pass come to a point one after the other; the last one sees what the others have written to
// coherent blocks before. GROUPS_DONE is a number in such a block, 0 between passes.
shared bool isLast;

// The invocations of a group see from here on what each of them has written before.
void awaitGroup() {
  memoryBarrierBuffer();
  barrier();
}

// For all invocations of a group; once a dispatch. `groups`: of the pass.
bool isLastGroupOf(uint groups) {
  awaitGroup();
  if (gl_LocalInvocationIndex == 0u) {
    isLast = atomicAdd(GROUPS_DONE, 1u) + 1u == groups;
    if (isLast) GROUPS_DONE = 0u;
  }
  barrier();
  memoryBarrierBuffer();
  return isLast;
}
