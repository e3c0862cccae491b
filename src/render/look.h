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

// Of linear light.
[[nodiscard]] glm::vec3 linearColor(Vec3d srgb);

// Of a collider, linear colour and gloss; red below 0: of a plane, the stage's ground.
[[nodiscard]] glm::vec4 drawnLook(const Collider& collider);

// The part of the block that differs from cloth to cloth.
void setClothLook(const RenderSettings& settings, shared::RenderFrame& frame);

// @param sky  irradiance of the sky's picture (render/environment.h)
[[nodiscard]] shared::RenderFrame makeLook(const RenderSettings& settings, glm::vec3 front,
                                           const std::array<glm::vec3, 9>& sky);

}  // namespace clothsim
