#include "simulation/gpu/solvers.h"

#include "core/error.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {

std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                   const Shared<Scene>& scene) {
  if (backend == "gpu") return std::make_unique<GpuSolver>(*cloth, scene);
  if (backend == "cpu") return makeCpuSolver(backend, cloth, scene);
  throw UsageError("there is no backend \"" + backend + "\"; choose gpu or cpu");
}

}  // namespace clothsim
