// Lights and colours of the picture, in linear RGB: everything a frame's uniform block holds that the camera
// does not move.
#pragma once

#include <array>

#include "scene/scene.h"
#include "shared/render_layout.h"

namespace clothsim {

// The unit vector towards the main light, the one that throws shadows.
// @param front  horizontal direction from which the cloth is looked at
[[nodiscard]] glm::vec3 directionToKeyLight(const RenderSettings& settings, glm::vec3 front);

// @param sky  irradiance of the sky's picture (render/environment.h)
[[nodiscard]] shared::RenderFrame makeLook(const RenderSettings& settings, glm::vec3 front,
                                           const std::array<glm::vec3, 9>& sky);

}  // namespace clothsim
