// Compares the backends from the state that is shown, on two solvers of its own. A card over the picture
// tells how many floats differ and how long each took.
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
  // Starts a comparison. @throws OpenGlError when the device has no memory for a second solver
  void start(Session& session);
  [[nodiscard]] bool isRunning() const { return running_; }
  [[nodiscard]] bool isOpen() const { return open_; }
  // Steps both solvers for a short time.
  void advance();
  void close();
  // To be called every frame with the time since the last one [s]. A result disappears after a while unless
  // the mouse points at it.
  void pass(double seconds);

  void draw(PictureArea area);
  // The part of the picture that the card covers; the camera keeps the scene out of it.
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
  float width_ = 0, height_ = 0;  // when it was last drawn [pixels]
};

}  // namespace clothsim
