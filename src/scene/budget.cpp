#include "scene/budget.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "core/error.h"

namespace clothsim {

double machineMemory() {
  double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  for (const char* limit : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double bytes = 0;
    if (std::ifstream(limit) >> bytes && bytes > 0) memory = std::min(memory, bytes);  // "max" is no number
  }
  return memory;
}

void checkMemory(double particles, double memory) {
  const double needed = particles * BYTES_A_PARTICLE;
  if (needed <= memory) return;
  std::array<char, 256> text{};
  std::snprintf(
      text.data(), text.size(),
      "the cloths hold %.0f particles together, which need about %.1f GB; this machine has %.1f GB. "
      "Use fewer points or a smaller --resolution.",
      particles, needed / 1e9, memory / 1e9);
  throw SceneError(text.data());
}

}  // namespace clothsim
