// GLSL text from the files under shaders/, with #include "..." resolved against shaders/, each file included
// once, and line numbers kept.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace clothsim::gl {

using Defines = std::vector<std::pair<std::string, std::string>>;  // name, value

struct ShaderSource {
  std::string text;  // begins with #version 450 core
  // #line directives in `text` number each line by the index here of the file that it came from.
  std::vector<std::string> files;
};
// @throws InputOutputError for a missing file, OpenGlError for an include that goes round in a circle
[[nodiscard]] ShaderSource loadShaderSource(const std::string& file, const Defines& defines);

// The driver's log with "0:12" or "0(12)" turned into "shaders/sim/step.comp:12".
[[nodiscard]] std::string readableLog(const std::string& log, const ShaderSource& source);

}  // namespace clothsim::gl
