// How fast a driver and its device do what steps are made of, for `clothsim probe`. Everything needs a
// current context.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gl/context.h"

namespace clothsim::gl {

// What was measured, its value and its unit.
using TellRate = std::function<void(const std::string&, double, const char*)>;

// The driver's limits that the passes depend on, by name.
[[nodiscard]] std::vector<std::pair<std::string, long long>> driverLimits();
// What a dispatch costs by itself, by the barrier behind it and what else changes in between. [us/dispatch]
// `small`: fewer repetitions, smaller sizes.
void measureDispatches(bool small, const TellRate& tell);
// Copies [GB/s], the 13 loads of a particle in a step [us], springs without any load [G/s].
void measureRoofs(bool small, const TellRate& tell);

struct WorkTime {
  double seconds = 0;  // until the device is done,
  double submit = 0;   // and until the calls return
};
// Does `work` `count` times, five times over: the median of one `work` [s].
template <class Work>
WorkTime timeWork(int count, Work work) {
  using Clock = std::chrono::steady_clock;
  work();  // some drivers compile now
  std::array<double, 5> whole{}, submit{};
  for (std::size_t repetition = 0; repetition < whole.size(); ++repetition) {
    finish();
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < count; ++i) work();
    submit[repetition] = std::chrono::duration<double>(Clock::now() - start).count() / count;
    finish();
    whole[repetition] = std::chrono::duration<double>(Clock::now() - start).count() / count;
  }
  std::sort(whole.begin(), whole.end());
  std::sort(submit.begin(), submit.end());
  return {whole[2], submit[2]};
}

}  // namespace clothsim::gl
