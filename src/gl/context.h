// An OpenGL 4.5 core context without a window, by EGL: a real GPU's device display first, then surfaceless.
// (The viewer's context comes from GLFW.)
#pragma once

#include <memory>
#include <string>

#include "core/error.h"

namespace clothsim::gl {

// Debug builds ask the driver for a debug context and for its messages at the call that caused them.
#ifdef NDEBUG
inline constexpr bool debugBuild = false;
#else
inline constexpr bool debugBuild = true;
#endif

struct ContextInfo {
  std::string vendor, renderer, version;
  int major = 0, minor = 0;
  long long maxStorageBlockBytes = 0;
  int maxWorkGroupInvocations = 0, maxWorkGroupCountX = 0;
  bool software = false;  // llvmpipe, softpipe, swrast
  // Dispatches of one batch do not see each other's writes as texels, whatever barrier stands between them,
  // so that each needs a batch of its own: zink. Seen with Mesa 22.3.6 on lavapipe (tools/validate
  // determinism).
  bool needsFlushes = false;
};

// Loads the functions of the current context, checks version 4.5 and the limits that the shaders need, and
// installs the debug callback (prints warnings; throws OpenGlError at the next checkErrors() in tests and
// debug builds).
// @throws OpenGlError: what was found, what is needed, what to do
ContextInfo initializeCurrentContext(void* (*getProcAddress)(const char*));
[[nodiscard]] ContextInfo currentContextInfo();

// @throws OpenGlError when the driver has reported an error since the last call.
void checkErrors(const char* where);

// Waits until everything asked for so far is done.
void finish();

// The driver has reset the device: what lay on it is lost, and this context draws and computes no more.
struct ContextLost : OpenGlError {
  using OpenGlError::OpenGlError;
};
// Asks the driver, which takes microseconds. @throws ContextLost
void checkContext();

// A current EGL context for as long as the object lives. @throws OpenGlError
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;
  [[nodiscard]] const ContextInfo& info() const { return info_; }

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  ContextInfo info_;
};

}  // namespace clothsim::gl
