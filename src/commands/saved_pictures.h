// The pictures and films that `run --save` asks for, as the run goes on.
#pragma once

#include <optional>
#include <vector>

#include "commands/commands.h"
#include "output/picture_output.h"
#include "simulation/gpu/simulation_renderer.h"

namespace clothsim {

class SavedPictures {
 public:
  // Of the names in options.saves those that isPicture(). @throws InputOutputError
  SavedPictures(const RunOptions& options, const Scene& scene, int frames);

  // Frame 0 and every frame that is done, in turn, of one simulation. @throws InputOutputError, as finish()
  // does, and OpenGlError
  void add(Simulation& simulation, int frame);
  void finish();

 private:
  PictureSettings settings_;
  std::vector<PictureOutput> pictures_;
  std::optional<SimulationRenderer> renderer_;  // from the first picture on
  std::optional<Camera> camera_;
};

}  // namespace clothsim
