#include "app/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/pace.h"
#include "app/simulation.h"
#include "app/viewer_keys.h"
#include "app/viewer_overlay.h"
#include "app/viewer_window.h"
#include "core/error.h"
#include "render/camera.h"
#include "render/renderer.h"

namespace clothsim {
namespace {

constexpr double NOTICE_SECONDS = 2.5;
constexpr double ZOOM_PER_STEP = 0.88;  // of the wheel

class Clock {
 public:
  // Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// 9216 -> "9,216"
std::string withCommas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, ",");
  return text;
}

// "llvmpipe (LLVM 15.0.6, 256 bits)" -> "llvmpipe", "NVIDIA H200/PCIe/SSE2" -> "NVIDIA H200"
std::string shortDevice(const std::string& device) { return device.substr(0, device.find_first_of("(/,")); }

const char* nameOf(Integrator integrator) { return integrator == Integrator::verlet ? "verlet" : "euler"; }

ViewerAction actionOf(int glfwKey) {
  switch (glfwKey) {
    case GLFW_KEY_P: return ViewerAction::pause;
    case GLFW_KEY_N: return ViewerAction::stepFrame;
    case GLFW_KEY_R: return ViewerAction::restart;
    case GLFW_KEY_B: return ViewerAction::toggleBackend;
    case GLFW_KEY_I: return ViewerAction::toggleIntegrator;
    case GLFW_KEY_SPACE: return ViewerAction::resetCamera;
    case GLFW_KEY_F1: return ViewerAction::toggleKeyList;
    case GLFW_KEY_F2: return ViewerAction::toggleOverlay;
    case GLFW_KEY_ESCAPE: return ViewerAction::quit;
    default: return ViewerAction::none;
  }
}
