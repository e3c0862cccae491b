#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <regex>

#include "app/commands.h"
#include "core/error.h"
#include "scene/material.h"
#include "scene/scene_io.h"

namespace clothsim {

GridSize parseSize(const std::string& text, const std::string& flag) {
  std::smatch match;
  if (!std::regex_match(text, match, std::regex("([0-9]{1,5})[xX]([0-9]{1,5})")))
    throw UsageError(flag + " " + text + ": expected WIDTHxHEIGHT, as 512x512");
  return {std::stoi(match[1]), std::stoi(match[2])};
}

RemarkedScene readScene(const SceneOptions& options) {
  RemarkedScene read{loadSceneByName(options.scene), {}};
  Scene& scene = read.scene;
  if (options.resolution) {
    const auto isStepCount = [](const std::string& setting) {
      return setting.starts_with("solver.simulation_steps=") || setting == "solver.integrator=implicit";
    };
    const bool stepsByHand = std::any_of(options.settings.begin(), options.settings.end(), isStepCount) ||
                             std::any_of(options.varied.begin(), options.varied.end(), isStepCount);
    const std::string remark =
        changeResolution(scene, options.resolution->columns, options.resolution->rows, stepsByHand);
    if (!remark.empty()) read.remarks.push_back(remark);
  }
  for (const std::string& setting : options.settings) setSceneValue(scene, setting);
  for (const std::string& setting : options.varied) setSceneValue(scene, setting, "--vary");
  if (usesMaterial(scene) && stepLength(scene.solver) > stableStep(scene) * (1 + 1e-9)) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(),
                  "steps of %.3g s may be too long for this material; up to %.3g s are surely stable: --set "
                  "solver.simulation_steps=%d, or auto",
                  stepLength(scene.solver), stableStep(scene), stableSteps(scene));
    read.remarks.emplace_back(text.data());
  }
  return read;
}

Scene loadScene(const SceneOptions& options) {
  RemarkedScene read = readScene(options);
  for (const std::string& remark : read.remarks) std::cerr << "clothsim: " << remark << '\n';
  return std::move(read.scene);
}

}  // namespace clothsim
