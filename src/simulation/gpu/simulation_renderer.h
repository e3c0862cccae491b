// Draws a simulation as it is now. update() takes over a changed scene, cloth and cuts; positions are always
// current.
#pragma once

#include <functional>
#include <optional>

#include "gl/buffer.h"
#include "render/renderer.h"
#include "simulation/simulation.h"

namespace clothsim {

class SimulationRenderer {
 public:
  // `simulation` must outlive the renderer. All functions need a current context. @throws OpenGlError
  SimulationRenderer(Simulation& simulation, const RenderOptions& options);

  // Takes over the scene, the cloth and the cuts that the simulation has now. @throws as the constructor
  void update();
  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  // From now until release() it shows the state as it is now and asks the simulation for nothing, so that
  // another thread may step it, on the CPU.
  void hold();
  void release() { heldTime_.reset(); }
  // Of the state that is shown.
  [[nodiscard]] std::vector<Particle4> positions();
  [[nodiscard]] Particle4 position(std::uint32_t particle);
  [[nodiscard]] double time() const { return heldTime_ ? *heldTime_ : simulation_.time(); }
  // As Renderer::setOptions(), also for what update() makes anew.
  void setOptions(const RenderOptions& options);

  // The name of a buffer with a vec4 a particle. It is the GPU solver's own; a state of the CPU is uploaded
  // once after each change.
  [[nodiscard]] GLuint positionsBuffer();

  // The functions of Renderer, with the positions and the time of the simulation.
  void draw(const Camera& camera, GLuint target, int width, int height);
  void drawOver(const Camera& camera, const gl::Framebuffer& target);
  void expose(int number, int count, const Camera& camera, GLuint target, int width, int height);
  // Calls update() first.
  [[nodiscard]] Image picture(const Camera& camera, int width, int height, int exposures = 1,
                              const std::function<void(int)>& before = {});
  [[nodiscard]] Pick pick(const Camera& camera, int width, int height, double x, double y);

 private:
  void takeVelocities();

  Simulation& simulation_;
  RenderOptions options_;
  std::optional<Renderer> renderer_;
  // The renderer shows these.
  Shared<Cloth> cloth_;
  Shared<Scene> scene_;
  Cuts cuts_;
  gl::Buffer<Particle4> uploaded_, velocities_;
  std::vector<Particle4> lastUpload_;
  std::optional<double> heldTime_;
  std::uint64_t uploadedVersion_ = 0, uploadedStep_ = 0;
};

}  // namespace clothsim
