#include "gl/requirements.h"

#include <array>
#include <cstdlib>

#include "core/error.h"
#include "gl/api.h"

namespace clothsim::gl {
namespace {

// What passes may take: as much as OpenGL 4.5 promises, but for a ninth storage buffer. A test holds the
// compiled passes to it.
constexpr std::array limits{
    NeededLimit{GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 9, "storage buffers in a compute shader"},
    NeededLimit{GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 8, "places for storage buffers"},
    NeededLimit{GL_MAX_COMPUTE_UNIFORM_BLOCKS, 14, "uniform blocks in a compute shader"},
    NeededLimit{GL_MAX_UNIFORM_BUFFER_BINDINGS, 84, "places for uniform blocks"},
    NeededLimit{GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, 16, "textures in a compute shader"},
    NeededLimit{GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 96, "places for textures"},
    NeededLimit{GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 1024, "invocations in a work group"},
    NeededLimit{GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, 32768, "bytes that a work group shares"},
};

// Some drivers announce compute shaders that do not run. This lets one write a number into a buffer.
bool computeWorks() {
  constexpr GLuint expected = 42;
  const char* text = R"(#version 450 core
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Answer { uint answer; };
void main() { answer = 42u; }
)";
  const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  GLuint answer = 0;
  if (linked == GL_TRUE) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, sizeof answer, &answer, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof answer, &answer);
    glUseProgram(0);
    glDeleteBuffers(1, &buffer);
  }
  glDeleteProgram(program);
  return answer == expected;
}

// Advice about environment variables that may limit OpenGL to less than the hardware can do.
std::string limitingVariables() {
  std::string text;
  for (const char* name :
       {"MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE", "LIBGL_DRIVERS_PATH", "GALLIUM_DRIVER",
        "LIBGL_ALWAYS_SOFTWARE", "MESA_LOADER_DRIVER_OVERRIDE", "__EGL_VENDOR_LIBRARY_FILENAMES"}) {
    const char* value = std::getenv(name);
    if (value == nullptr) continue;
    text += std::string("\n             - unset the environment variable ") + name +
            ", which limits OpenGL here (" + name + "=" + value + ")";
  }
  return text;
}

}  // namespace

std::span<const NeededLimit> neededLimits() { return limits; }

std::string missingCapability(const ContextInfo& info) {
  if (info.major * 10 + info.minor < 45) return "that is older than 4.5";
  for (const NeededLimit& limit : limits) {
    GLint allowed = 0;
    glGetIntegerv(limit.name, &allowed);
    if (allowed < limit.least)
      return "it allows " + std::to_string(allowed) + " " + limit.what + ", fewer than " +
             std::to_string(limit.least);
  }
  if (!computeWorks()) return "its compute shaders do not work";
  return "";
}

std::string describeContext(const ContextInfo& info) {
  return info.vendor + ", " + info.renderer + ", OpenGL " + info.version;
}

std::string noUsableOpenGl(const std::string& found) {
  return "No usable OpenGL.\n  found:     " + found +
         "\n  needed:    OpenGL 4.5 core with compute shaders"
         "\n  what to do:" +
         limitingVariables() +
         "\n             - install a driver; on Debian the software one is in the packages libegl1 and "
         "libgl1-mesa-dri"
         "\n             - or simulate without OpenGL: clothsim run --backend cpu";
}

void requireCapabilities(const ContextInfo& info) {
  const std::string missing = missingCapability(info);
  if (!missing.empty()) throw OpenGlError(noUsableOpenGl(describeContext(info) + "; " + missing));
}

}  // namespace clothsim::gl
