#include "render/stage_look.h"

#include <array>
#include <string>

#include "core/error.h"

namespace clothsim {
namespace {

constexpr StageLook STUDIO{.name = "studio",  // a warm key, a cool fill from the other side, on pale paper
                           .define = "STUDIO",
                           .toKey = {-0.55f, 1.0f, 0.42f},
                           .toFill = {0.9f, 0.25f, 0.35f},
                           .key = {1.22f, 1.15f, 1.04f},
                           .fill = {0.16f, 0.20f, 0.28f},
                           .sky = {0.34f, 0.38f, 0.44f},
                           .bounce = {0.25f, 0.22f, 0.20f},
                           .ground = {0.76, 0.745, 0.725},
                           .surface = {0, 0, 0, 0},
                           .backdropTop = {0.24f, 0.25f, 0.27f},
                           .backdropBottom = {0.86f, 0.85f, 0.85f},
                           .corners = 0.45f};

// The studio's light before an even backdrop.
constexpr StageLook bare() {
  StageLook look = STUDIO;
  look.name = "none";
  look.define = "BARE";
  look.ground = {0.70, 0.73, 0.76};
  look.backdropTop = {0.0843f, 0.1195f, 0.1714f};     // sRGB 0.32, 0.38, 0.45
  look.backdropBottom = {0.3419f, 0.4064f, 0.4770f};  // sRGB 0.62, 0.67, 0.72
  look.corners = 0;
  return look;
}

const std::array<StageLook, stages.size()>& stageLooks() {
  static const std::array<StageLook, stages.size()> looks{{
      STUDIO,
      {.name = "table",  // in a warm room
       .define = "TABLE",
       .toKey = {-0.65f, 0.95f, 0.30f},
       .toFill = {0.9f, 0.3f, 0.35f},
       .key = {1.34f, 1.20f, 1.00f},
       .fill = {0.10f, 0.12f, 0.16f},
       .sky = {0.30f, 0.30f, 0.31f},
       .bounce = {0.24f, 0.17f, 0.11f},
       .ground = {0.86, 0.82, 0.79},
       .surface = {1 / 1.2f, 1, 0.55f, 0},
       .backdropTop = {},
       .backdropBottom = {},
       .corners = 0.35f,
       .groundPicture = "ground_boards",
       .groundShape = GroundShape::table},
      {.name = "window",  // low light from the left
       .define = "WINDOW",
       .toKey = {-0.95f, 0.82f, 0.38f},
       .toFill = {0.9f, 0.4f, 0.5f},
       .key = {1.50f, 1.40f, 1.22f},
       .fill = {0.06f, 0.07f, 0.10f},
       .sky = {0.35f, 0.37f, 0.41f},
       .bounce = {0.25f, 0.21f, 0.17f},
       .ground = {0.86, 0.83, 0.79},
       .surface = {1 / 1.2f, 0.80f, 0.35f, 0},
       .backdropTop = {},
       .backdropBottom = {},
       .corners = 0.25f,
       .groundPicture = "ground_boards",
       .groundShape = GroundShape::room},
      {.name = "dark",  // a spot from above, and a cold light from behind
       .define = "DARK",
       .toKey = {-0.42f, 1.15f, 0.40f},
       .toFill = {0.75f, 0.35f, -0.8f},
       .key = {1.62f, 1.48f, 1.26f},
       .fill = {0.13f, 0.17f, 0.27f},
       .sky = {0.085f, 0.095f, 0.12f},
       .bounce = {0.10f, 0.08f, 0.06f},
       .ground = {0.62, 0.60, 0.60},
       .surface = {1 / 1.2f, 1, 0.45f, 0},
       .backdropTop = {},
       .backdropBottom = {},
       .corners = 0.3f,
       .groundPicture = "ground_boards",
       .groundShape = GroundShape::room},
      bare(),
  }};
  return looks;
}

}  // namespace

const StageLook& stageLook(std::string_view name) {
  std::string known;
  for (const StageLook& look : stageLooks()) {
    if (look.name == name) return look;
    known.append(known.empty() ? "" : ", ").append(look.name);
  }
  throw SceneError("render.stage: there is no stage \"" + std::string(name) + "\"; there is: " + known);
}

gl::Defines stageDefines(const RenderSettings& settings) {
  gl::Defines defines{{std::string(stageLook(settings.stage).define), ""}};
  if (backdropShowsGround(settings)) defines.emplace_back("GROUND_BEHIND", "");
  return defines;
}

gl::Defines backdropDefines(const RenderSettings& settings) {
  if (settings.background == "sky") return {{"SKY", ""}};
  if (settings.background == "plain") return {{"PLAIN", ""}};
  return stageDefines(settings);
}

bool backdropShowsGround(const RenderSettings& settings) {
  return settings.background == "studio" && settings.stage != "none";
}

bool backdropTurns(const RenderSettings& settings) {
  return settings.background == "sky" || backdropShowsGround(settings);
}

}  // namespace clothsim
