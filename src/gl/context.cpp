#include "gl/context.h"

#include <iostream>
#include <vector>

#include "core/error.h"
#include "gl/api.h"
#include "gl/requirements.h"

namespace clothsim::gl {
namespace {

// What the debug callback has collected since the last checkErrors(). The driver may call it from a thread of
// its own unless output is synchronous, which debug builds ask for.
thread_local std::vector<std::string> driverErrors;

void GLAD_API_PTR onDebugMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length,
                                 const GLchar* message, const void*) {
  // Compiler messages come with the file and line from Program, which throws them at once.
  if (severity == GL_DEBUG_SEVERITY_NOTIFICATION || source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
  const std::string text(
      message, length >= 0 ? static_cast<std::size_t>(length) : std::char_traits<char>::length(message));
  if (type == GL_DEBUG_TYPE_ERROR) {
    driverErrors.push_back(text);
  } else if (severity != GL_DEBUG_SEVERITY_LOW && type != GL_DEBUG_TYPE_PERFORMANCE) {
    std::cerr << "OpenGL warning: " << text << '\n';
  }
}

void installDebugCallback() {
  glEnable(GL_DEBUG_OUTPUT);
  if (debugBuild) glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onDebugMessage, nullptr);
}

const char* errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown error";
  }
}

const char* resetCause(GLenum status) {
  if (status == GL_GUILTY_CONTEXT_RESET) return "after a fault of this program's work on it";
  if (status == GL_INNOCENT_CONTEXT_RESET) return "after a fault of another program";
  return "for an unknown reason";
}

}  // namespace

ContextInfo initializeCurrentContext(void* (*getProcAddress)(const char*)) {
  const auto load = [](void* loader, const char* name) {
    const auto function = *static_cast<void* (**)(const char*)>(loader);
    return reinterpret_cast<GLADapiproc>(function(name));
  };
  const int version = gladLoadGLUserPtr(load, &getProcAddress);
  if (version == 0) throw OpenGlError(noUsableOpenGl("a context whose functions could not be loaded"));
  const ContextInfo info = currentContextInfo();
  requireCapabilities(info);
  installDebugCallback();
  return info;
}

ContextInfo currentContextInfo() {
  const auto text = [](GLenum name) {
    const GLubyte* value = glGetString(name);
    return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "unknown");
  };
  ContextInfo info;
  info.vendor = text(GL_VENDOR);
  info.renderer = text(GL_RENDERER);
  info.version = text(GL_VERSION);
  glGetIntegerv(GL_MAJOR_VERSION, &info.major);
  glGetIntegerv(GL_MINOR_VERSION, &info.minor);
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"}) {
    if (info.renderer.find(name) != std::string::npos) info.software = true;
  }
  info.needsFlushes = info.renderer.starts_with("zink");
  if (info.major * 10 + info.minor >= 43) {  // older contexts do not know these names
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    info.maxStorageBlockBytes = bytes;
    glGetIntegerv(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, &info.maxWorkGroupInvocations);
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &info.maxWorkGroupCountX);
  }
  return info;
}

void finish() { glFinish(); }

void checkContext() {
  const GLenum status = glGetGraphicsResetStatus();
  if (status == GL_NO_ERROR) return;
  throw ContextLost(std::string("the OpenGL context was lost: the driver reset the GPU ") +
                    resetCause(status) +
                    ", and everything on it is gone. Run it again, or with --backend cpu");
}

void checkErrors(const char* where) {
  // Asked first: a driver that runs calls in a thread of its own catches up here, and reports what it found.
  // Bounded: a lost context reports errors for ever.
  std::string names;
  for (int i = 0; i < 16; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    names += std::string("\n  ") + errorName(error);
  }
  std::string messages;
  for (const std::string& text : driverErrors) messages += "\n  " + text;
  driverErrors.clear();
  messages += names;
  if (!messages.empty()) throw OpenGlError(std::string("OpenGL error in ") + where + ":" + messages);
}

}  // namespace clothsim::gl
