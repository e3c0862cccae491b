#include <algorithm>
#include <iostream>

#include "app/commands.h"
#include "scene/scene_io.h"

namespace clothsim {

Scene loadScene(const SceneOptions& options) {
  Scene scene = loadSceneByName(options.scene);
  if (options.resolution) {
    const bool stepsByHand = std::any_of(
        options.settings.begin(), options.settings.end(),
        [](const std::string& setting) { return setting.starts_with("solver.simulation_steps="); });
    const std::string remark =
        changeResolution(scene, options.resolution->columns, options.resolution->rows, stepsByHand);
    if (!remark.empty()) std::cerr << "clothsim: " << remark << '\n';
  }
  for (const std::string& setting : options.settings) setSceneValue(scene, setting);
  if (scene.solver.selfCollision == SelfCollision::averaged)
    std::cerr << "clothsim: self-collision \"averaged\" is CS184's rule and lets fast cloth through; "
                 "--set solver.self_collision=robust holds\n";
  return scene;
}

}  // namespace clothsim
