// What the shaders need of an OpenGL context, and the message for a machine that lacks it.
#pragma once

#include <span>
#include <string>

#include "gl/api.h"
#include "gl/context.h"

namespace clothsim::gl {

// A limit of drivers, and how much of it passes may take.
struct NeededLimit {
  GLenum name;
  int least;
  const char* what;  // for messages
};
[[nodiscard]] std::span<const NeededLimit> neededLimits();

// The current context's first shortcoming as a phrase ("it has no ..."), empty when it can do everything.
[[nodiscard]] std::string missingCapability(const ContextInfo& info);

// "Mesa, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"
[[nodiscard]] std::string describeContext(const ContextInfo& info);

// Three parts: what was found, what is needed, what to do. Names the environment variables that limit OpenGL.
[[nodiscard]] std::string noUsableOpenGl(const std::string& found);

// @throws OpenGlError(noUsableOpenGl(...)) when the current context lacks something
void requireCapabilities(const ContextInfo& info);

}  // namespace clothsim::gl
