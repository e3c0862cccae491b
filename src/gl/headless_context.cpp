// HeadlessContext: EGL displays tried one after the other, until one gives a context that can do what the
// shaders need.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gl/api.h"
#include "gl/context.h"
#include "gl/requirements.h"

namespace clothsim::gl {
namespace {

// Opened when the first context is made: whoever computes on the CPU alone needs no OpenGL installed.
class Egl {
 public:
  decltype(&eglGetError) getError = function<decltype(&eglGetError)>("eglGetError");
  decltype(&eglGetProcAddress) getProcAddress = function<decltype(&eglGetProcAddress)>("eglGetProcAddress");
  decltype(&eglQueryString) queryString = function<decltype(&eglQueryString)>("eglQueryString");
  decltype(&eglCreateContext) createContext = function<decltype(&eglCreateContext)>("eglCreateContext");
  decltype(&eglChooseConfig) chooseConfig = function<decltype(&eglChooseConfig)>("eglChooseConfig");
  decltype(&eglMakeCurrent) makeCurrent = function<decltype(&eglMakeCurrent)>("eglMakeCurrent");
  decltype(&eglDestroyContext) destroyContext = function<decltype(&eglDestroyContext)>("eglDestroyContext");
  decltype(&eglInitialize) initialize = function<decltype(&eglInitialize)>("eglInitialize");
  decltype(&eglBindAPI) bindApi = function<decltype(&eglBindAPI)>("eglBindAPI");

 private:
  template <class Function>
  static Function function(const char* name) {
    static void* const library = ::dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL);
    if (library == nullptr)
      throw OpenGlError(noUsableOpenGl("no libEGL.so.1 (Debian: libegl1 and libgl1-mesa-dri)"));
    void* found = ::dlsym(RTLD_DEFAULT, name);  // what is preloaded comes first
    if (found == nullptr) throw OpenGlError(noUsableOpenGl(std::string("a libEGL.so.1 without ") + name));
    return reinterpret_cast<Function>(found);
  }
};
// @throws OpenGlError where the library is not installed
const Egl& egl() {
  static const Egl functions;
  return functions;
}

struct Candidate {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string name;  // for messages
};

bool hasExtension(const char* list, std::string_view name) {
  std::istringstream words(list != nullptr ? list : "");
  for (std::string word; words >> word;) {
    if (word == name) return true;
  }
  return false;
}

std::string eglErrorName() {
  const EGLint error = egl().getError();
  switch (error) {
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return "EGL error " + std::to_string(error);
  }
}

template <class Function>
Function eglFunction(const char* name) {
  return reinterpret_cast<Function>(egl().getProcAddress(name));
}

void* glFunction(const char* name) { return reinterpret_cast<void*>(egl().getProcAddress(name)); }

// Device displays, hardware before software, then Mesa's surfaceless platform.
std::vector<Candidate> displayCandidates() {
  const char* client = egl().queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platformDisplay = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (platformDisplay == nullptr) return {};

  std::vector<Candidate> hardware, software;
  const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto queryDeviceString = eglFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const bool hasDevices = hasExtension(client, "EGL_EXT_platform_device") && queryDevices != nullptr &&
                          queryDeviceString != nullptr;
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (hasDevices && queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
    for (EGLint i = 0; i < count; ++i) {
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      const bool isSoftware =
          hasExtension(queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
      const Candidate candidate{platformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                                "EGL device " + std::to_string(i) + (isSoftware ? " (software)" : "")};
      (isSoftware ? software : hardware).push_back(candidate);
    }
  }
  std::vector<Candidate> all = hardware;
  all.insert(all.end(), software.begin(), software.end());
  if (hasExtension(client, "EGL_MESA_platform_surfaceless")) {
    all.push_back(
        {platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "EGL surfaceless"});
  }
  return all;
}

// `tellsOfResets`: glGetGraphicsResetStatus says when the device was reset.
EGLContext makeContext(EGLDisplay display, EGLConfig config, std::optional<std::pair<int, int>> version,
                       bool tellsOfResets) {
  std::vector<EGLint> attributes;
  if (version) {
    attributes = {EGL_CONTEXT_MAJOR_VERSION,       version->first,
                  EGL_CONTEXT_MINOR_VERSION,       version->second,
                  EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (debugBuild) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    if (tellsOfResets)
      attributes.insert(attributes.end(),
                        {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  }
  attributes.push_back(EGL_NONE);
  return egl().createContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

EGLConfig chooseConfig(EGLDisplay display) {
  const std::array<EGLint, 3> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (hasExtension(egl().queryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context"))
    return EGL_NO_CONFIG_KHR;
  egl().chooseConfig(display, wanted.data(), &config, 1, &count);
  return count > 0 ? config : EGL_NO_CONFIG_KHR;
}

}  // namespace

struct HeadlessContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~Handles() {
    if (display == EGL_NO_DISPLAY) return;
    egl().makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) egl().destroyContext(display, context);
    // The display itself stays initialized: EGL hands the same one to every caller in the process, and
    // terminating it would pull it from under a second context.
  }

  // Makes a context of `candidate` current; throws OpenGlError with what was found instead.
  static std::unique_ptr<Handles> open(const Candidate& candidate, ContextInfo& info) {
    const auto fail = [&](const std::string& what) { throw OpenGlError(candidate.name + ": " + what); };
    auto handles = std::make_unique<Handles>();
    if (candidate.display == EGL_NO_DISPLAY) fail("no display");
    if (egl().initialize(candidate.display, nullptr, nullptr) != EGL_TRUE)
      fail("eglInitialize: " + eglErrorName());
    handles->display = candidate.display;
    if (egl().bindApi(EGL_OPENGL_API) != EGL_TRUE) fail("no desktop OpenGL: " + eglErrorName());
    const EGLConfig config = chooseConfig(candidate.display);
    for (const bool tellsOfResets : {true, false})  // not every driver can
      if (handles->context == EGL_NO_CONTEXT)
        handles->context = makeContext(candidate.display, config, std::pair{4, 5}, tellsOfResets);
    std::string refusal;
    if (handles->context == EGL_NO_CONTEXT) {
      // Any context at all, so that the message can say which version there is.
      refusal = "a 4.5 core context was refused (" + eglErrorName() + ")";
      handles->context = makeContext(candidate.display, config, std::nullopt, false);
    }
    if (handles->context == EGL_NO_CONTEXT) fail(refusal);
    if (egl().makeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles->context) != EGL_TRUE) {
      fail("eglMakeCurrent: " + eglErrorName());
    }
    if (gladLoadGLUserPtr([](void*, const char* name) { return egl().getProcAddress(name); }, nullptr) == 0) {
      fail("the context's functions could not be loaded");
    }
    info = currentContextInfo();
    const std::string missing = missingCapability(info);
    if (!missing.empty()) fail(describeContext(info) + "; " + missing);
    info = initializeCurrentContext(glFunction);
    return handles;
  }
};

HeadlessContext::HeadlessContext() {
  std::string found;
  for (const Candidate& candidate : displayCandidates()) {
    try {
      handles_ = Handles::open(candidate, info_);
      return;
    } catch (const OpenGlError& error) {
      found += (found.empty() ? "" : "\n             ") + std::string(error.what());
    }
  }
  throw OpenGlError(noUsableOpenGl(found.empty() ? "EGL without any device or surfaceless display" : found));
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace clothsim::gl
