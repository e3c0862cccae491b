// The subcommands behind `clothsim`, one function each; the command line itself is in command_line.cpp.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

// Parses argv, runs the subcommand, prints errors to stderr; returns the exit code of DESIGN.md section 5.
int runCommandLine(int argc, char** argv);

// What every command that simulates takes.
struct SceneArguments {
  std::string scene;  // -f
  std::optional<std::pair<int, int>> resolution;
  std::vector<std::string> settings;  // --set key=value
};
// Loads the scene, changes its resolution, applies --set in that order. @throws SceneError, UsageError
[[nodiscard]] Scene loadSceneWith(const SceneArguments& arguments);

}  // namespace clothsim
