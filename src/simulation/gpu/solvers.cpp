#include "simulation/gpu/solvers.h"

#include <cstdio>

#include "core/error.h"
#include "gl/context.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {

std::string chosenBackend(const std::string& wish) {
  if (wish != "auto") return wish;
  return gl::currentContextInfo().software ? "cpu" : "gpu";
}

std::string announcedBackend(const std::string& wish) {
  const std::string chosen = chosenBackend(wish);
  if (wish == "auto" && chosen == "cpu")
    std::fputs(
        "clothsim: simulating on the CPU, since OpenGL is a software renderer; --backend gpu forces the "
        "GPU\n",
        stderr);
  return chosen;
}

std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                   const Shared<Scene>& scene) {
  if (backend == "gpu") return std::make_unique<GpuSolver>(*cloth, scene);
  if (backend == "cpu") return makeCpuSolver(backend, cloth, scene);
  throw UsageError("there is no backend \"" + backend + "\"; choose gpu or cpu");
}

}  // namespace clothsim
