// A scene as a command line asks for it: by name, with another resolution and other values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

struct GridSize {
  int columns = 0, rows = 0;
};

// What every command that simulates takes.
struct SceneOptions {
  std::string scene = "pinned2";         // -f: as loadSceneByName() takes it
  std::optional<GridSize> resolution{};  // --resolution
  std::vector<std::string> settings{};   // --set key=value
  std::vector<std::string> varied{};     // --vary: one combination of its values, set after the settings
};

// The scene, its resolution changed and the settings applied, and what the user should know of the result.
// @throws SceneError, UsageError
struct RemarkedScene {
  Scene scene;
  std::vector<std::string> remarks;  // sentences
};
[[nodiscard]] RemarkedScene readScene(const SceneOptions& options);
// The same for a scene that was read elsewhere: options.scene is not looked at.
[[nodiscard]] RemarkedScene changedScene(Scene from, const SceneOptions& options);

}  // namespace clothsim
