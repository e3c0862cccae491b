// The bar below the picture, with the stored frames to choose from and the buttons for pause, screenshot and
// recording.
#pragma once

#include <optional>

#include "viewer/viewer_overlay.h"

namespace clothsim {

struct TimelineState {
  int oldest = 0, now = 0, newest = 0;  // numbers of frames, counted over all restarts
  int shownNumber = 0;                  // of `now`, counted from its restart
  double frameSeconds = 1.0 / 90;
  bool paused = false;
  double tempo = 1;                       // simulated seconds per second that are wanted
  std::optional<double> recordedSeconds;  // while a clip is being recorded
};

struct TimelineRequests {
  std::optional<int> seek;
  bool togglePause = false, stepBack = false, stepForward = false, screenshot = false,
       toggleRecording = false, slowMotion = false;
  friend bool operator==(const TimelineRequests&, const TimelineRequests&) = default;
};

// Height of the bar [pixels].
[[nodiscard]] float timelineHeight();

[[nodiscard]] TimelineRequests drawTimeline(const TimelineState& state, PictureArea area);

}  // namespace clothsim
