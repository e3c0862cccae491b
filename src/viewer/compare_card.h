// Compare: both backends step on from the state that is shown, on solvers of their own, and a card tells how
// many floats differ and how long each took.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "render/camera.h"
#include "session/session.h"
#include "simulation/compare.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

class CompareCard {
 public:
  // Begins anew. @throws OpenGlError when the device has no room for a second solver
  void start(Session& session);
  [[nodiscard]] bool isRunning() const { return running_; }
  [[nodiscard]] bool isOpen() const { return open_; }
  // A frame on each backend, or less where that takes long.
  void advance();
  void close();
  // So much time has passed [s]: a result that nobody points at goes away after a while.
  void pass(double seconds);

  void draw(PictureArea area);
  // The part of the picture that it covers, for a camera that looks past it.
  [[nodiscard]] CoveredEdges coveredEdges(PictureArea area) const;

 private:
  struct Side {
    std::unique_ptr<Solver> solver;
    std::string device;
    double seconds = 0;
  };
  void step(Side& side, int count) const;

  std::optional<Shared<Cloth>> cloth_;  // the solvers keep a pointer to it
  Side gpu_, cpu_;
  int steps_ = 0, stepsAtOnce_ = 1;
  std::uint64_t particles_ = 0;
  StateDifference difference_;
  bool running_ = false, open_ = false, pointedAt_ = false;
  double secondsLeft_ = 0;
  float width_ = 0, height_ = 0;  // as it was drawn last [pixels]
};

}  // namespace clothsim
