// Takes screenshots and clips of the open scene, without the panels.
#pragma once

#include <optional>
#include <string>

#include "output/clip_recorder.h"
#include "viewer/open_scene.h"

namespace clothsim {

class PictureTaker {
 public:
  // Writes scene-backend-frame.png. Returns a message for the user. @throws InputOutputError
  std::string screenshot(OpenScene& open, int width, int height, int exposures);
  // Starts a clip, or ends it. Returns and throws as screenshot().
  std::string toggleClip(OpenScene& open, int width, int height);
  // To be called when the picture has been shown for that time [s]; adds it to a clip. @throws
  // InputOutputError
  void shown(OpenScene& open, double seconds);
  // Ends a clip that runs, whose film is kept. Returns a message for the user, "" where there was none.
  // @throws InputOutputError
  std::string endClip();

  [[nodiscard]] std::optional<double> recordedSeconds() const {
    return clip_ ? std::optional(clip_->seconds()) : std::nullopt;
  }

 private:
  std::optional<ClipRecorder> clip_;
};

}  // namespace clothsim
