// Which threads of the program go first where there are fewer cores than threads.
#pragma once

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace clothsim {

// The calling thread, and those that it starts from now on, leave the cores to the program's other threads
// where these want them. Linux alone has that for single threads; elsewhere nothing changes.
inline void giveWay() {
#ifdef __linux__
  constexpr int steps = 5;  // of niceness: a third of the time of a thread that is as it was
  static_cast<void>(setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + steps));
#endif
}

}  // namespace clothsim
