#include "measure/recent_steps.h"

#include <algorithm>

namespace clothsim {

constexpr double RECENT_SECONDS = 1;

void RecentSteps::add(double time, const ConvergenceCounts& counts) {
  if (!samples_.empty() && (time < samples_.back().time || counts.steps < samples_.back().counts.steps))
    samples_.clear();
  if (!samples_.empty() && time == samples_.back().time) samples_.pop_back();
  samples_.push_back({time, counts});
  while (samples_.size() > 2 && samples_[1].time <= time - RECENT_SECONDS) samples_.pop_front();
}

ConvergenceCounts RecentSteps::all() const {
  return samples_.empty() ? ConvergenceCounts{} : samples_.back().counts;
}

ConvergenceCounts RecentSteps::recent() const {
  return samples_.empty() ? ConvergenceCounts{} : all() - samples_.front().counts;
}

double RecentSteps::largestUpdate() const {
  double largest = 0;
  for (std::size_t i = 1; i < samples_.size(); ++i)
    largest = std::max(largest, samples_[i].counts.lastUpdate);
  return largest;
}

}  // namespace clothsim
