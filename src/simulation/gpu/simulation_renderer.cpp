#include "simulation/gpu/simulation_renderer.h"

#include "solver/gpu/gpu_solver.h"

namespace clothsim {

SimulationRenderer::SimulationRenderer(Simulation& simulation, const RenderOptions& options)
    : simulation_(simulation),
      options_(options),
      cloth_(simulation.sharedCloth()),
      scene_(simulation.sharedScene()) {
  renderer_.emplace(cloth_, scene_, options_);
}

void SimulationRenderer::hold() {
  update();
  static_cast<void>(positionsBuffer());
  takeVelocities();
  heldTime_ = simulation_.time();
}

std::vector<Particle4> SimulationRenderer::positions() {
  return heldTime_ ? lastUpload_ : simulation_.state().positions;
}

Particle4 SimulationRenderer::position(std::uint32_t particle) {
  return heldTime_ ? lastUpload_[particle] : simulation_.solver().positions(particle, 1).front();
}

void SimulationRenderer::update() {
  if (heldTime_) return;
  if (!cloth_.isSameAs(simulation_.sharedCloth())) {
    renderer_.emplace(simulation_.sharedCloth(), simulation_.sharedScene(), options_);
    cloth_ = simulation_.sharedCloth();
    scene_ = simulation_.sharedScene();
    cuts_.clear();
  }
  if (scene_ != simulation_.sharedScene()) renderer_->configure(simulation_.sharedScene());
  scene_ = simulation_.sharedScene();
  if (const Cuts& cuts = simulation_.solver().cuts(); cuts != cuts_) {
    renderer_->setCuts(cuts);
    cuts_ = cuts;
  }
}

void SimulationRenderer::setOptions(const RenderOptions& options) {
  renderer_->setOptions(options);
  options_ = options;
}

GLuint SimulationRenderer::positionsBuffer() {
  if (heldTime_) return uploaded_.name();
  if (const auto* gpu = dynamic_cast<const GpuSolver*>(&simulation_.solver())) return gpu->positionsBuffer();
  const std::uint64_t version = simulation_.version(), step = simulation_.solver().stepIndex();
  const std::size_t particles = simulation_.cloth().particleCount();
  const bool isNew = uploaded_.name() == 0 || uploaded_.size() != particles;
  if (isNew) uploaded_ = gl::Buffer<Particle4>("positions to draw", particles);
  if (isNew || uploadedVersion_ != version || uploadedStep_ != step) {
    lastUpload_ = simulation_.state().positions;
    uploaded_.upload(lastUpload_);
    uploadedVersion_ = version;
    uploadedStep_ = step;
  }
  return uploaded_.name();
}

// Of the state as it is now, where the picture shows them.
void SimulationRenderer::takeVelocities() {
  if (heldTime_) return;
  renderer_->setVelocities(0);
  if (simulation_.scene().camera.shutter == 0) return;
  velocities_ = gl::Buffer<Particle4>("velocities to draw", simulation_.state().velocities);
  renderer_->setVelocities(velocities_.name());
}

void SimulationRenderer::draw(const Camera& camera, GLuint target, int width, int height) {
  renderer_->draw(positionsBuffer(), camera, time(), target, width, height);
}

void SimulationRenderer::drawOver(const Camera& camera, const gl::Framebuffer& target) {
  renderer_->drawOver(positionsBuffer(), camera, time(), target);
}

void SimulationRenderer::expose(int number, int count, const Camera& camera, GLuint target, int width,
                                int height) {
  if (number == 0) takeVelocities();
  renderer_->expose(number, count, positionsBuffer(), camera, time(), target, width, height);
}

Image SimulationRenderer::picture(const Camera& camera, int width, int height, int exposures,
                                  const std::function<void(int)>& before) {
  update();
  if (exposures > 1) takeVelocities();
  return renderImage(*renderer_, positionsBuffer(), camera, time(), width, height, exposures, before);
}

Pick SimulationRenderer::pick(const Camera& camera, int width, int height, double x, double y) {
  return renderer_->pick(positionsBuffer(), camera, time(), width, height, x, y);
}

}  // namespace clothsim
