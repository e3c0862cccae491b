// Lights and colours of the picture, in linear RGB: everything a frame's uniform block holds that the camera
// does not move.
#pragma once

#include "scene/scene.h"
#include "shared/render_layout.h"

namespace clothsim {

// The unit vector towards the main light, the one that throws shadows.
// @param front  horizontal direction from which the cloth is looked at
[[nodiscard]] glm::vec3 directionToKeyLight(glm::vec3 front);

[[nodiscard]] shared::RenderFrame makeLook(const RenderSettings& settings, glm::vec3 front);

}  // namespace clothsim
