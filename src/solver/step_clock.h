// Simulated time. It is counted in whole steps since the last change of the step length: so it does not
// drift, and a change of the step length does not move it.
#pragma once

#include <cstdint>

namespace clothsim {

struct StepClock {
  std::uint64_t step = 0;  // steps since the start
  double stepLength = 0;   // [s]; 0 until a solver sets it (state files before version 3 do not hold it)
  double originTime = 0;   // [s], the time when the step length became what it is,
  std::uint64_t originStep = 0;  // after so many steps

  // Once `steps` more are done [s].
  [[nodiscard]] double timeAfter(std::uint64_t steps) const {
    return originTime + static_cast<double>(step - originStep + steps) * stepLength;
  }
  [[nodiscard]] double time() const { return timeAfter(0); }  // [s]

  // Of the steps to come [s].
  void setStepLength(double seconds) {
    if (seconds == stepLength) return;
    if (stepLength > 0) {
      originTime = time();
      originStep = step;
    }
    stepLength = seconds;
  }
  friend bool operator==(const StepClock&, const StepClock&) = default;
};

}  // namespace clothsim
