#include <algorithm>
#include <cstdio>
#include <iostream>

#include "app/commands.h"
#include "scene/material.h"
#include "scene/scene_io.h"

namespace clothsim {

Scene loadScene(const SceneOptions& options) {
  Scene scene = loadSceneByName(options.scene);
  if (options.resolution) {
    const bool stepsByHand =
        std::any_of(options.settings.begin(), options.settings.end(), [](const std::string& setting) {
          return setting.starts_with("solver.simulation_steps=") || setting == "solver.integrator=implicit";
        });
    const std::string remark =
        changeResolution(scene, options.resolution->columns, options.resolution->rows, stepsByHand);
    if (!remark.empty()) std::cerr << "clothsim: " << remark << '\n';
  }
  for (const std::string& setting : options.settings) setSceneValue(scene, setting);
  if (usesMaterial(scene) && stepLength(scene.solver) > stableStep(scene) * (1 + 1e-9))
    std::fprintf(
        stderr,
        "clothsim: steps of %.3g s may be too long for this material; up to %.3g s are surely stable: --set "
        "solver.simulation_steps=%d, or auto\n",
        stepLength(scene.solver), stableStep(scene), stableSteps(scene));
  if (scene.solver.selfCollision == SelfCollision::averaged)
    std::cerr << "clothsim: self-collision \"averaged\" is CS184's rule and lets fast cloth through; "
                 "--set solver.self_collision=robust holds\n";
  return scene;
}

}  // namespace clothsim
