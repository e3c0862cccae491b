// The files that `run --save` asks for, as the run goes on.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "commands/commands.h"
#include "export/sequence.h"
#include "output/picture_output.h"
#include "render/renderer.h"
#include "simulation/simulation.h"

namespace clothsim {

// Before the run. @throws UsageError for names that say nothing to us, InputOutputError
void checkSaves(const RunOptions& options);
// Whether there is something to draw, which takes OpenGL.
[[nodiscard]] bool savesPictures(const RunOptions& options);

class Saves {
 public:
  Saves(const RunOptions& options, const Simulation& simulation, int frames);

  // Frame 0 and every frame that is done. `clothGeneration`: another one when the simulation has another
  // cloth. @throws InputOutputError, as finish() does
  void add(Simulation& simulation, std::uint64_t clothGeneration, const State& state, int frame);
  void finish();

 private:
  void draw(Simulation& simulation, std::uint64_t clothGeneration, const State& state, int frame);

  const RunOptions& options_;
  int frames_;
  PictureSettings pictureSettings_;
  std::vector<std::unique_ptr<SequenceWriter>> sequences_;
  std::vector<PictureOutput> pictures_;
  std::optional<Renderer> renderer_;  // of the cloth of that generation
  std::optional<Camera> camera_;
  std::uint64_t drawnCloth_ = 0;
};

}  // namespace clothsim
