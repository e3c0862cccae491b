// Times the phases of a displayed frame for `clothsim --timings`: by the host's clock, waiting for what a
// phase draws, and by the device's. Costs nothing when it is off.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "gl/timer.h"

namespace clothsim {

class FrameTimings {
 public:
  enum Phase { input, simulate, picture, controls, drawControls, swap, after, PHASES };

  explicit FrameTimings(bool on) : timer_(on ? std::make_unique<gl::Timer>() : nullptr) {}

  template <class Work>
  void time(Phase phase, Work&& work) {
    if (timer_ == nullptr) {
      work();
      return;
    }
    const auto start = std::chrono::steady_clock::now();
    const bool draws = phase == picture || phase == drawControls;
    if (draws) timer_->begin();
    work();
    if (draws) timer_->end();
    if (draws) device_[phase] += timer_->seconds();  // waits for the device
    host_[phase] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    frames_ += phase == swap ? 1 : 0;
  }

  // So much was simulated since the last call [s].
  void simulated(double seconds) { simulated_ += seconds; }

  // A line for each phase, and the pace; "" when it is off or nothing was drawn.
  [[nodiscard]] std::string report() const;

 private:
  std::unique_ptr<gl::Timer> timer_;
  std::array<double, PHASES> host_{}, device_{};
  int frames_ = 0;
  double simulated_ = 0;
};

}  // namespace clothsim
