// Keeps simulated time at the pace of the wall clock, whatever the frame rate of the display. On a slow
// machine the simulation runs slower than real time: where the display waits for them, the number of frames
// simulated for each displayed one is limited so that it stays fluent, and the rest is skipped.
#pragma once

#include <algorithm>

namespace clothsim {

class Pace {
 public:
  explicit Pace(double frameSeconds) : frameSeconds_(frameSeconds) {}  // simulated time of one frame [s]

  // The number of frames to simulate now, `elapsed` [s] after the last call. `displayWaits`: the next picture
  // is not drawn before they are done.
  [[nodiscard]] int framesDue(double elapsed, bool displayWaits = true) {
    owed_ += elapsed;
    const double due = owed_ / frameSeconds_;
    const int most = displayWaits ? mostFrames() : mostFramesAtOnce;
    if (due >= most + 1) {
      owed_ = 0;
      return most;
    }
    const int frames = std::min(static_cast<int>(due), most);
    owed_ -= frames * frameSeconds_;
    return frames;
  }

  // To be called with the time that simulating the frames took [s].
  void simulated(int frames, double seconds) {
    if (frames > 0) cost_ += 0.25 * (seconds / frames - cost_);
  }

  // Wall time until the next frame is due [s].
  [[nodiscard]] double secondsUntilDue() const { return std::max(0.0, frameSeconds_ - owed_); }

  static constexpr int mostFramesAtOnce = 12;
  static constexpr double simulationBudget = 1 / 20.0;  // for simulating, per displayed frame [s]

 private:
  [[nodiscard]] int mostFrames() const {
    return cost_ * mostFramesAtOnce <= simulationBudget
               ? mostFramesAtOnce
               : std::max(1, static_cast<int>(simulationBudget / cost_));
  }

  double frameSeconds_;
  double owed_ = 0;  // wall time that has not been simulated yet [s]
  double cost_ = 0;  // of simulating a frame, smoothed [s]
};

// Displayed frames per second and simulated seconds per second, averaged over half a second so that they are
// readable.
class SpeedMeter {
 public:
  void add(double elapsed, double simulated, int pictures = 1) {
    wall_ += elapsed;
    simulated_ += simulated;
    frames_ += pictures;
    if (wall_ < windowSeconds) return;
    isMeasured_ = true;
    framesPerSecond_ = frames_ / wall_;
    realTimeFactor_ = simulated_ / wall_;
    steppingShare_ = stepping_ / wall_;
    drawingShare_ = drawing_ / wall_;
    wall_ = simulated_ = stepping_ = drawing_ = 0;
    frames_ = 0;
  }
  // Time that went into steps and into pictures [s].
  void spent(double stepping, double drawing) {
    stepping_ += stepping;
    drawing_ += drawing;
  }
  [[nodiscard]] double steppingShare() const { return steppingShare_; }  // parts of the wall time
  [[nodiscard]] double drawingShare() const { return drawingShare_; }
  [[nodiscard]] bool isMeasured() const { return isMeasured_; }  // once the first half second is over
  [[nodiscard]] double framesPerSecond() const { return framesPerSecond_; }
  [[nodiscard]] double realTimeFactor() const { return realTimeFactor_; }

 private:
  static constexpr double windowSeconds = 0.5;  // [s]
  double wall_ = 0, simulated_ = 0, stepping_ = 0, drawing_ = 0;
  int frames_ = 0;
  bool isMeasured_ = false;
  double framesPerSecond_ = 0, realTimeFactor_ = 0, steppingShare_ = 0, drawingShare_ = 0;
};

}  // namespace clothsim
