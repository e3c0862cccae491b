// How implicit steps of the last second of simulated time ended, for the viewer. The numbers come from
// samples, a few of them a second.
#pragma once

#include <deque>

#include "solver/executor.h"

namespace clothsim {

class RecentSteps {
 public:
  // `time`: simulated [s]; `counts`: up to then. Where either goes back, it is another run.
  void add(double time, const ConvergenceCounts& counts);
  // The latest that was added; without any, zeros.
  [[nodiscard]] ConvergenceCounts all() const;
  // From the last sample that is a second old, or the first one, to the latest.
  [[nodiscard]] ConvergenceCounts recent() const;
  // The largest last update of these samples.
  [[nodiscard]] double largestUpdate() const;

 private:
  struct Sample {
    double time = 0;
    ConvergenceCounts counts;
  };
  std::deque<Sample> samples_;  // the first one is where the recent steps begin
};

}  // namespace clothsim
