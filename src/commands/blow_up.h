// What a command does when the watchdog has found trouble: save the last good state, and end with a message
// that says where the trouble began and how to go on.
#pragma once

#include <filesystem>
#include <string>

#include "commands/commands.h"
#include "simulation/simulation.h"

namespace clothsim {

struct BlowUpContext {
  const SceneOptions& scene;
  std::string backend;
  int frame = 0, frames = 0;           // the one with the trouble, and how many were asked for
  std::filesystem::path outputFolder;  // "" for the current one
  bool replays = false;                // scene.scene is a recording, which no command goes on with
};
// After simulation.checkFrame(): saves the state as <scene>-frame<N>-last-good.state in the folder, under a
// free name where another file has that one. @throws SimulationError always
[[noreturn]] void stopBlownUp(const Trouble& trouble, Simulation& simulation, const BlowUpContext& context);

}  // namespace clothsim
