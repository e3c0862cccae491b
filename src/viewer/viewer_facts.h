// The title of the window and the rows of the overlay, as they describe the simulation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/run_watch.h"
#include "viewer/open_scene.h"
#include "viewer/pace.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

[[nodiscard]] std::string viewerTitle(const OpenScene& open, const SpeedMeter& meter, bool paused);
// `exposures`: of how many the picture is the mean, where it is refined.
[[nodiscard]] OverlayFacts viewerFacts(const OpenScene& open, const SpeedMeter& meter, bool paused,
                                       double tempo, std::optional<int> exposures,
                                       const std::vector<Warning>& warnings);

}  // namespace clothsim
