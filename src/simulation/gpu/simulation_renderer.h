// Draws a simulation as it is now: a renderer that follows its scene, cloth and cuts, and the positions that
// it draws from.
#pragma once

#include <optional>

#include "gl/buffer.h"
#include "render/renderer.h"
#include "simulation/simulation.h"

namespace clothsim {

class SimulationRenderer {
 public:
  // Keeps a reference to the simulation. Needs a current context, as everything here. @throws OpenGlError
  SimulationRenderer(Simulation& simulation, const RenderOptions& options);

  // Shows the scene, the cloth and the cuts that the simulation has now. @throws as the constructor
  void update();
  [[nodiscard]] Renderer& renderer() { return *renderer_; }

  // The name of a buffer with a vec4 a particle: the GPU solver's own, or the CPU's state, uploaded once
  // after each change.
  [[nodiscard]] GLuint positionsBuffer();

  // As Renderer has them, with the positions and the time of the simulation.
  void draw(const Camera& camera, GLuint target, int width, int height);
  [[nodiscard]] Image picture(const Camera& camera, int width, int height);
  [[nodiscard]] Pick pick(const Camera& camera, int width, int height, double x, double y);

 private:
  Simulation& simulation_;
  RenderOptions options_;
  std::optional<Renderer> renderer_;
  // What the renderer shows.
  Shared<Cloth> cloth_;
  Shared<Scene> scene_;
  Cuts cuts_;
  gl::Buffer<Particle4> uploaded_;
  std::uint64_t uploadedVersion_ = 0, uploadedStep_ = 0;
};

}  // namespace clothsim
