// The solver factory of programs with OpenGL.
#pragma once

#include <memory>
#include <string>

#include "simulation/simulation.h"

namespace clothsim {

// For "auto" the backend that is faster with the current context: "gpu" where OpenGL is hardware, "cpu" where
// it is a software renderer, which is the CPU by a detour. Any other wish as it is.
[[nodiscard]] std::string chosenBackend(const std::string& wish);
// The same, and a line on stderr where that is the CPU instead of the GPU.
[[nodiscard]] std::string announcedBackend(const std::string& wish);

// Knows "gpu", which needs a current context, and "cpu". @throws UsageError for another name, OpenGlError
[[nodiscard]] std::unique_ptr<Solver> makeSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                                 const Shared<Scene>& scene);

}  // namespace clothsim
