#include "commands/commands.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

// Each frame takes memory for pictures and copies of the state, and gives it back. Left to itself the C
// library returns it to the system each time, which then has to clear the same pages again: 7 % of the time
// of `clothsim run -f demo --resolution 96x96 --frames 200 --backend cpu --threads 1`.
static void keepFreedMemory() {
#if defined(__GLIBC__)
  constexpr int ownMappingFrom = 32 << 20, mostKept = 256 << 20;  // [B]
  mallopt(M_MMAP_THRESHOLD, ownMappingFrom);
  mallopt(M_TRIM_THRESHOLD, mostKept);
#endif
}

int main(int argc, char** argv) {
  keepFreedMemory();
  return clothsim::runCommandLine(argc, argv);
}
