// The ways to shade cloth, by the name that scenes and --shader use: each is one fragment shader in
// shaders/render/.
#pragma once

#include <string>
#include <vector>

#include "gl/program.h"

namespace clothsim {

[[nodiscard]] std::vector<std::string> shadingModelNames();

// @throws SceneError for a name that does not exist, listing those that do; OpenGlError
[[nodiscard]] gl::Program makeShadingModel(const std::string& name);

}  // namespace clothsim
