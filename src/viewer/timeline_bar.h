// The bar below the picture: looking back over the frames that are kept, going on from any of them, and
// recording.
#pragma once

#include <optional>

#include "viewer/viewer_overlay.h"

namespace clothsim {

struct TimelineState {
  int oldest = 0, now = 0, newest = 0;  // frames, over all restarts
  int shownNumber = 0;                  // of `now`, from its restart on
  double frameSeconds = 1.0 / 90;
  bool paused = false;
  std::optional<double> recordedSeconds;  // while a clip is being recorded
};

struct TimelineRequests {
  std::optional<int> seek;
  bool togglePause = false, stepBack = false, stepForward = false, screenshot = false,
       toggleRecording = false;
};

// Height of the bar [pixels].
[[nodiscard]] float timelineHeight();

[[nodiscard]] TimelineRequests drawTimeline(const TimelineState& state, PictureArea area);

}  // namespace clothsim
