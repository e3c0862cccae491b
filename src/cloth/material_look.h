// How fabrics look: what a scene's `render` holds where it names a material and says nothing else.
#pragma once

#include "scene/scene.h"

namespace clothsim {

// The look of the first cloth's material: of that preset with which it has most values in common, so that
// denim that bends more easily is still denim. RenderSettings{} without a material, or where it is like none
// of them.
[[nodiscard]] RenderSettings usualLook(const Scene& scene);

// After a change of the material: what `render` had from the look before, it has from the one after.
void followLook(RenderSettings& render, const RenderSettings& before, const RenderSettings& after);

}  // namespace clothsim
