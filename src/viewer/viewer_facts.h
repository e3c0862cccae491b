// The title of the window and the rows of the overlay, as they describe the simulation.
#pragma once

#include <string>
#include <vector>

#include "measure/run_watch.h"
#include "viewer/open_scene.h"
#include "viewer/pace.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

[[nodiscard]] const char* nameOf(Integrator integrator);
[[nodiscard]] std::string viewerTitle(const OpenScene& open, const SpeedMeter& meter, bool paused);
[[nodiscard]] OverlayFacts viewerFacts(const OpenScene& open, const SpeedMeter& meter, bool paused,
                                       bool looksBack, double tempo, const std::vector<Warning>& warnings);

}  // namespace clothsim
