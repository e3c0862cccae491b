// Waiting for another thread without sleep, for as long as that may be worth it.
#pragma once

#include <chrono>
#include <thread>

namespace clothsim {

// Longer than the pauses between the passes of a step, about as long as it takes to wake a thread up.
inline constexpr std::chrono::microseconds LONGEST_SPIN{60};

// Returns whether done() came to be true.
template <class Done>
bool spinUntil(Done done) {
  if (done()) return true;
  constexpr int looksByTheClock = 64;  // one takes several times as long on some processors as on others
  const auto end = std::chrono::steady_clock::now() + LONGEST_SPIN;
  do {
    for (int look = 0; look < looksByTheClock; ++look) {
      if (done()) return true;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#else
      std::this_thread::yield();
#endif
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace clothsim
