// Waiting for another thread without sleep, for as long as that may be worth it.
#pragma once

#include <thread>

namespace clothsim {

// How often a thread looks before it gives up: some 20 to 50 us, longer than the pauses between the passes of
// a step.
inline constexpr int SPIN_LOOKS = 1000;

// Returns whether done() came to be true.
template <class Done>
bool spinUntil(Done done) {
  for (int look = 0; look < SPIN_LOOKS; ++look) {
    if (done()) return true;
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
  }
  return false;
}

}  // namespace clothsim
