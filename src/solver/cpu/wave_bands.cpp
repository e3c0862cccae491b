#include "solver/cpu/wave_bands.h"

#include <cassert>

namespace clothsim::cpu {

template <class Real>
WaveBands<Real>::WaveBands(const Wave& wave, int rows, int count) : wave_(&wave), rows_(rows) {
  assert(count >= 1 && count <= rows && "a band has a row at least");
  for (int number = 0; number < count; ++number) {
    Band& band = bands_.emplace_back();
    band.first = static_cast<int>(std::int64_t{rows} * number / count);
    band.end = static_cast<int>(std::int64_t{rows} * (number + 1) / count);
  }
}

template <class Real>
void WaveBands<Real>::begin() {
  for (std::size_t seam = 1; seam < bands_.size(); ++seam) {
    Band &upper = bands_[seam - 1], &lower = bands_[seam];
    const Clock::duration aRow = (upper.time + lower.time) / (lower.end - upper.first);
    if (upper.time > lower.time + aRow && upper.end > upper.first + 1) upper.end = --lower.first;
    if (lower.time > upper.time + aRow && lower.end > lower.first + 1) upper.end = ++lower.first;
  }
  for (Band& band : bands_) {
    band.fronts.store(0, std::memory_order_relaxed);
    band.isTaken.clear(std::memory_order_relaxed);
  }
}

template class WaveBands<float>;
template class WaveBands<double>;

}  // namespace clothsim::cpu
