// A progress bar on stderr, shown only when stderr is a terminal, so that logs and pipes stay clean.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace clothsim {

// The bar's text, `width` columns at most: label, bar, percent, elapsed and remaining time. `elapsed` in
// seconds.
[[nodiscard]] std::string progressLine(const std::string& label, std::int64_t done, std::int64_t total,
                                       double elapsed, int width, bool color);

class Progress {
 public:
  Progress(std::string label, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Redraws at most ten times a second.
  void update(std::int64_t done);
  // Clears the bar's line, so that what is printed next stands alone. The destructor does so, too.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::int64_t total_;
  Clock::time_point start_;
  Clock::time_point drawn_;
  bool visible_;  // stderr is a terminal
  bool color_;    // stderr is a terminal, and NO_COLOR is not set
  bool onScreen_ = false;
};

}  // namespace clothsim
