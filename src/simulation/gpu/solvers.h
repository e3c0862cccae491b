// The solver factory of programs with OpenGL.
#pragma once

#include <memory>
#include <string>

#include "simulation/simulation.h"

namespace clothsim {

// Knows "gpu", which needs a current context, and "cpu". @throws UsageError for another name, OpenGlError
[[nodiscard]] std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                                 const Shared<Scene>& scene);

}  // namespace clothsim
