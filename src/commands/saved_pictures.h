// The pictures and films that `run --save` asks for, frame by frame.
#pragma once

#include <optional>
#include <vector>

#include "commands/commands.h"
#include "output/picture_output.h"
#include "simulation/gpu/simulation_renderer.h"

namespace clothsim {

class SavedPictures {
 public:
  // Saves those names in options.saves for which isPicture() holds. @throws InputOutputError
  SavedPictures(const RunOptions& options, const Scene& scene, int frames);

  // To be called for frame 0 and after every frame, with the same simulation. @throws InputOutputError as
  // finish() does, and OpenGlError
  void add(Simulation& simulation, int frame);
  void finish();

 private:
  PictureSettings settings_;
  int exposures_ = 1;  // of which each picture is the mean
  std::vector<PictureOutput> pictures_;
  std::optional<SimulationRenderer> renderer_;  // made for the first picture
  std::optional<Camera> camera_;
};

}  // namespace clothsim
