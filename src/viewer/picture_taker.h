// Screenshots and clips of the scene that is open, without the panels.
#pragma once

#include <optional>
#include <string>

#include "output/clip_recorder.h"
#include "viewer/open_scene.h"

namespace clothsim {

class PictureTaker {
 public:
  // Writes scene-backend-frame.png. Returns a sentence for the user. @throws InputOutputError
  std::string screenshot(OpenScene& open, int width, int height);
  // Begins a clip, or ends it. As screenshot().
  std::string toggleClip(OpenScene& open, int width, int height);
  // The picture was shown for so long [s]; a clip takes what it needs of that. @throws InputOutputError
  void shown(OpenScene& open, double seconds);
  void abandonClip() { clip_.reset(); }

  [[nodiscard]] std::optional<double> recordedSeconds() const {
    return clip_ ? std::optional(clip_->seconds()) : std::nullopt;
  }

 private:
  std::optional<ClipRecorder> clip_;
};

}  // namespace clothsim
