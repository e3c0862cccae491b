// The stages of render.stage: lights, ground and surroundings of a scene. What is behind it all is drawn by
// shaders/render/walls.glsl.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "gl/program.h"
#include "scene/scene.h"

namespace clothsim {

// How far the ground goes: beyond the picture, to the edge of a table, or to the round wall of a room.
enum class GroundShape { endless, table, room };

// Light in linear RGB; directions as the viewer of the front sees them: x to the right, y up, z to the
// viewer.
struct StageLook {
  std::string_view name;    // of `stages`
  std::string_view define;  // of the shaders
  glm::vec3 toKey, toFill;
  glm::vec3 key, fill, sky, bounce;  // as in shared::RenderFrame
  Vec3d ground;                      // sRGB: its colour, which tints its picture
  glm::vec4 surface;                 // shared::RenderFrame::ground, without w
  glm::vec3 backdropTop, backdropBottom;
  float corners = 0;  // how much darker the backdrop is in the picture's corners
  std::string_view groundPicture{};
  GroundShape groundShape = GroundShape::endless;
};

// @throws SceneError for a name that is none of `stages`
[[nodiscard]] const StageLook& stageLook(std::string_view name);

// What the shaders of the ground and of whatever stands on it are compiled with, and those of the backdrop.
[[nodiscard]] gl::Defines stageDefines(const RenderSettings& settings);
[[nodiscard]] gl::Defines backdropDefines(const RenderSettings& settings);

// Whether the stage's ground is in the backdrop, as far as it is seen, without shadows.
[[nodiscard]] bool backdropShowsGround(const RenderSettings& settings);
// Whether the backdrop changes as the camera moves.
[[nodiscard]] bool backdropTurns(const RenderSettings& settings);

}  // namespace clothsim
