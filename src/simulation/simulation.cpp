#include "simulation/simulation.h"

#include "core/error.h"
#include "core/interrupt.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {

std::unique_ptr<Solver> makeSolver(const std::string& backend, const Cloth& cloth, const Scene& scene) {
  if (backend == "cpu") return std::make_unique<CpuSolver<float>>(cloth, scene);
  if (backend == "gpu") return std::make_unique<GpuSolver>(cloth, scene);
  throw UsageError("there is no backend \"" + backend + "\"; choose gpu or cpu");
}

Simulation::Simulation(const Scene& scene, const std::string& backend)
    : scene_(scene), cloth_(std::make_unique<Cloth>(scene)), solver_(makeSolver(backend, *cloth_, scene)) {}

std::optional<Trouble> Simulation::checkFrame() {
  stopIfInterrupted();
  const std::optional<Trouble> trouble = solver_->trouble();
  if (trouble) {
    solver_->revert();
    uploadIsCurrent_ = false;
  }
  return trouble;
}

void Simulation::restart() {
  solver_->setState(initialState(*cloth_, scene_));
  uploadIsCurrent_ = false;
}

void Simulation::configure(const Scene& scene) {
  solver_->configure(scene);
  scene_ = scene;
}

void Simulation::rebuild(const Scene& scene) {
  auto cloth = std::make_unique<Cloth>(scene);
  auto solver = makeSolver(solver_->backend(), *cloth, scene);
  contactsBefore_ = contactCounts();
  solver_ = std::move(solver);  // before the cloth that the old one points to
  cloth_ = std::move(cloth);
  scene_ = scene;
  uploaded_ = {};
  uploadIsCurrent_ = false;
}

void Simulation::switchBackend(const std::string& backend) {
  std::unique_ptr<Solver> solver = makeSolver(backend, *cloth_, scene_);
  solver->setState(solver_->state());
  contactsBefore_ = contactCounts();
  solver_ = std::move(solver);
  uploadIsCurrent_ = false;
}

GLuint Simulation::positionsBuffer() {
  if (const auto* gpu = dynamic_cast<const GpuSolver*>(solver_.get())) return gpu->positionsBuffer();
  if (uploaded_.name() == 0) uploaded_ = gl::Buffer<Particle4>("positions to draw", cloth_->particleCount());
  if (!uploadIsCurrent_ || uploadedStep_ != solver_->stepIndex()) {
    uploaded_.upload(solver_->state().positions);
    uploadIsCurrent_ = true;
    uploadedStep_ = solver_->stepIndex();
  }
  return uploaded_.name();
}

std::string blowUpText(const Trouble& trouble, const Cloth& cloth, const Scene& scene) {
  return "the simulation blew up: " + troubleText(trouble, cloth, scene) + ". " +
         remedyFor(trouble, scene).text;
}

}  // namespace clothsim
