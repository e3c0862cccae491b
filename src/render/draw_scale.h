// Dynamic resolution: in how many pixels a scene is drawn, so that a picture keeps within a budget of time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace clothsim {

class DrawScale {
 public:
  explicit DrawScale(double budget) : budget_(budget) {}  // [s]; 0: full size, whatever it takes

  // Of the picture's width and height, 1 to LEAST.
  [[nodiscard]] double scale() const { return SCALES[step_]; }

  // To be called with the time that a picture of this scale took [s].
  void drawn(double seconds) {
    if (budget_ <= 0 || ++pictures_ <= SETTLING) return;  // the first ones also make the targets
    // A middle of the last few, so that one picture that was interrupted counts for nothing.
    recent_[next_++ % recent_.size()] = seconds;
    if (next_ < recent_.size()) return;
    std::array<double, 5> sorted = recent_;
    std::nth_element(sorted.begin(), sorted.begin() + 2, sorted.end());
    const double cost = sorted[2];
    if (cost > 1.1 * budget_) {
      // What it costs grows with the number of pixels, so that the fitting scale is known at once.
      const double fitting = scale() * std::sqrt(budget_ / cost);
      std::size_t step = step_ + 1;
      while (step + 1 < SCALES.size() && SCALES[step] > 1.08 * fitting) ++step;
      changeTo(std::min(step, SCALES.size() - 1));
    } else if (step_ > 0 && pictures_ >= patience_) {
      const double larger = SCALES[step_ - 1] / scale();
      if (cost * larger * larger < 0.85 * budget_) changeTo(step_ - 1);
    }
  }

  static constexpr std::array<double, 6> SCALES{1, 0.9, 0.81, 0.73, 0.66, 0.6};
  static constexpr double LEAST = SCALES.back();

 private:
  static constexpr std::size_t SETTLING = 2, PATIENCE = 30;

  void changeTo(std::size_t step) {
    if (step == step_) return;
    // Who has just grown too large waits longer before the next attempt.
    patience_ = step > step_ && pictures_ < 2 * PATIENCE ? std::min(8 * patience_, 16 * PATIENCE) : PATIENCE;
    step_ = step;
    pictures_ = next_ = 0;
  }

  double budget_;
  std::size_t step_ = 0, pictures_ = 0, next_ = 0, patience_ = PATIENCE;
  std::array<double, 5> recent_{};
};

}  // namespace clothsim
