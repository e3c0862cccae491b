#include "simulation/gpu/solvers.h"

#include "core/error.h"
#include "gl/context.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {

std::string chosenBackend(const std::string& wish) {
  if (wish != "auto") return wish;
  return gl::currentContextInfo().software ? "cpu" : "gpu";
}

std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                   const Shared<Scene>& scene) {
  if (backend == "gpu") return std::make_unique<GpuSolver>(*cloth, scene);
  if (backend == "cpu") return makeCpuSolver(backend, cloth, scene);
  throw UsageError("there is no backend \"" + backend + "\"; choose gpu or cpu");
}

}  // namespace clothsim
