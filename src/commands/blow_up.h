// How a command ends when the watchdog has found divergence: it saves the last sound state and throws a
// message that says where the divergence began and how to continue.
#pragma once

#include <filesystem>
#include <string>

#include "commands/commands.h"
#include "simulation/simulation.h"

namespace clothsim {

struct BlowUpContext {
  SceneOptions scene;
  std::string backend;
  int frame = 0, frames = 0;           // of the divergence, and in the whole run
  std::filesystem::path outputFolder;  // "" for the current folder
  std::string filesText;               // what is said of the files of the run; "" or lines
  const RunOptions* run = nullptr;     // whose files the command that continues saves, too
  bool replays = false;                // scene.scene is a recording, from which no command can continue
};
// To be called after simulation.checkFrame(). Saves the state as <scene>-frame<N>-last-good.state in the
// folder, with a number added where another file has that name. @throws SimulationError always
[[noreturn]] void stopBlownUp(const Divergence& divergence, Simulation& simulation,
                              const BlowUpContext& context);

}  // namespace clothsim
