// How the pieces of a scene's cloth are drawn: all of one look, or each of its own.
#pragma once

#include <vector>

#include "render/shading_models.h"

namespace clothsim {

struct PieceLook {
  RenderSettings settings;
  ShadingModel model;
};

// One, where all cloths look alike, else one for each. `thick`: as for shadingModelOf().
[[nodiscard]] std::vector<PieceLook> looksOf(const Scene& scene, bool thick);

}  // namespace clothsim
