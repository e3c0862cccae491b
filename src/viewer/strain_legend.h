#pragma once

#include <optional>

#include "scene/scene.h"
#include "viewer/viewer_overlay.h"

namespace clothsim {

// The colours of the strain map, at the lower right of the picture and `lift` above its edge, with a mark for
// the strain l/L - 1 under the cursor.
void drawStrainLegend(const RenderSettings& look, std::optional<double> underCursor, PictureArea area,
                      float lift);

}  // namespace clothsim
