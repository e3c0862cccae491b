// A solver on the GPU.
#pragma once

#include "solver/gpu/gpu_executor.h"
#include "solver/solver.h"

namespace clothsim {

class GpuSolver final : public Solver {
 public:
  // `cloth` must outlive the solver; needs a current context. @throws as GpuExecutor
  GpuSolver(const Cloth& cloth, const Shared<Scene>& scene, const GpuOptions& options = {})
      : Solver(cloth, scene, std::make_unique<GpuExecutor>(cloth, options)) {}

  // One vec4 a particle: xyz and the inverse mass. The name changes from step to step.
  [[nodiscard]] GLuint positionsBuffer() const {
    return static_cast<const GpuExecutor&>(executor()).positionsBuffer();
  }
};

}  // namespace clothsim
