// Where cloth that hangs from pins may go: straight down from them, to and fro below them, downwind, and
// along with them on their paths.
#pragma once

#include "render/stage.h"

namespace clothsim {

// Adds that to the stage of a grid that has pins. `rest`: around its points at the start.
void addPinnedCloth(const ClothOutline::GridPoints& piece, const ClothSettings& settings, const Scene& scene,
                    const Bounds& rest, Stage& stage);

// Times at which a path is looked at [s]: its keys, and in between for as long as it turns.
[[nodiscard]] std::vector<double> timesAlong(const Motion& motion);

}  // namespace clothsim
