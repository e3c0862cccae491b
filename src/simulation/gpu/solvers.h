// The solvers of both backends, for programs with OpenGL.
#pragma once

#include <memory>
#include <string>

#include "simulation/simulation.h"

namespace clothsim {

// "gpu" or "cpu"; the GPU needs a current OpenGL context. @throws UsageError for another name, OpenGlError
[[nodiscard]] std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                                 const Shared<Scene>& scene);

}  // namespace clothsim
