#include "simulation/simulation.h"

#include "core/error.h"
#include "core/interrupt.h"
#include "solver/cpu/cpu_solver.h"

namespace clothsim {

std::unique_ptr<Solver> makeCpuSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                      const Shared<Scene>& scene) {
  if (backend == "cpu") return std::make_unique<CpuSolver<float>>(*cloth, scene);
  throw UsageError("there is no backend \"" + backend + "\" here; expected cpu");
}

Simulation::Simulation(const Shared<Scene>& scene, const std::string& backend, SolverFactory makeSolver)
    : scene_(scene),
      cloth_(Cloth(*scene)),
      makeSolver_(makeSolver),
      solver_(makeSolver(backend, cloth_, scene_)) {}

void Simulation::stepFrames(int frames) {
  keep();
  step(frames * scene_->solver.simulationSteps);
}

std::optional<Divergence> Simulation::checkFrame() {
  stopIfInterrupted();
  const std::optional<Divergence> divergence = solver_->divergence();
  if (divergence) {
    solver_->revert();
    touch();
  }
  return divergence;
}

void Simulation::setState(const State& state) {
  solver_->setState(state);
  touch();
}

void Simulation::restart() { setState(initialState(*cloth_, *scene_)); }

ConvergenceCounts Simulation::convergenceCounts() {
  ConvergenceCounts counts = convergenceBefore_ + solver_->convergenceCounts();
  if (!isImplicit(scene_->solver.integrator)) counts.lastUpdate = 0;
  return counts;
}

void Simulation::replaceSolver(std::unique_ptr<Solver> solver) {
  contactsBefore_ = contactCounts();
  convergenceBefore_ = convergenceBefore_ + solver_->convergenceCounts();
  solver_ = std::move(solver);
}

void Simulation::configure(const Shared<Scene>& scene) {
  solver_->configure(scene);
  scene_ = scene;
}

void Simulation::rebuild(const Shared<Scene>& scene) {
  const Shared<Cloth> cloth(Cloth{*scene});
  std::unique_ptr<Solver> solver = makeSolver_(solver_->backend(), cloth, scene);
  replaceSolver(std::move(solver));  // before its cloth goes
  cloth_ = cloth;
  scene_ = scene;
  touch();
}

void Simulation::switchBackend(const std::string& backend) {
  std::unique_ptr<Solver> solver = makeSolver_(backend, cloth_, scene_);
  solver->setState(solver_->state());
  replaceSolver(std::move(solver));
  touch();
}

std::string blowUpText(const Divergence& divergence, const Cloth& cloth, const Scene& scene,
                       std::optional<int> frame) {
  return "the simulation blew up: " + divergenceText(divergence, cloth, scene, frame) + ". " +
         remedyFor(divergence, scene).text;
}

}  // namespace clothsim
