// Preloaded into the program, loses its OpenGL context once: once the file named by LOSE_CONTEXT_WHEN exists,
// the driver says that the device was reset.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace {

unsigned resetStatus() {
  constexpr unsigned innocentReset = 0x8254, noError = 0;
  static bool told = false;
  const char* file = std::getenv("LOSE_CONTEXT_WHEN");
  if (told || file == nullptr || ::access(file, F_OK) != 0) return noError;
  told = true;
  return innocentReset;
}

using GetFunction = void (*(*)(const char*))();
using Function = void (*)();

Function functionNamed(const char* name, const char* loader) {
  if (std::strcmp(name, "glGetGraphicsResetStatus") == 0) return reinterpret_cast<Function>(&resetStatus);
  return reinterpret_cast<GetFunction>(::dlsym(RTLD_NEXT, loader))(name);
}

}  // namespace

extern "C" Function eglGetProcAddress(const char* name) { return functionNamed(name, "eglGetProcAddress"); }
extern "C" Function glfwGetProcAddress(const char* name) { return functionNamed(name, "glfwGetProcAddress"); }
