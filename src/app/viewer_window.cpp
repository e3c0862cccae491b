#include "app/viewer_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "gl/context.h"
#include "gl/requirements.h"

namespace clothsim {
namespace {

constexpr int ordinaryWidth = 1280, ordinaryHeight = 720;  // at first, on an ordinary screen [pixels]
constexpr int smallestWidth = 480, smallestHeight = 400;

std::string lastGlfwError() {
  const char* text = nullptr;
  return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? "GLFW gives no reason" : text;
}

// For those who have no screen: the same scene by the commands that need none.
std::string noWindow(const std::string& reason, const std::string& sceneName) {
  return "No window can be opened: " + reason + "\nThese commands need no screen:\n  clothsim render -f " +
         sceneName +
         " --frames 240 --out clip.mp4     a film, or a picture with --out still.png\n  clothsim run -f " +
         sceneName + " --frames 240 --save last.ply      the simulation alone, as a mesh";
}

// As large as the screen's scale asks for, as long as it fits on it.
std::pair<int, int> firstSize() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return {ordinaryWidth, ordinaryHeight};
  float scale = 1, unused = 1;
  glfwGetMonitorContentScale(monitor, &scale, &unused);
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  const auto fit = [scale](int wanted, int most) {
    const int scaled = static_cast<int>(static_cast<float>(wanted) * std::max(1.0f, scale));
    return most > 0 ? std::min(scaled, most) : scaled;
  };
  return {fit(ordinaryWidth, width), fit(ordinaryHeight, height)};
}

void* loadFunction(const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

}  // namespace

ViewerWindow::ViewerWindow(const std::string& title, const std::string& sceneName) {
  if (glfwInit() == GLFW_FALSE) throw OpenGlError(noWindow(lastGlfwError(), sceneName));
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "clothsim");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "clothsim");
  const auto [width, height] = firstSize();
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = lastGlfwError();
    glfwTerminate();
    throw OpenGlError(gl::noUsableOpenGl("a screen, but no window with OpenGL 4.5 on it: " + reason));
  }
  glfwSetWindowSizeLimits(window_, smallestWidth, smallestHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  try {
    gl::initializeCurrentContext(loadFunction);
  } catch (...) {
    glfwTerminate();
    throw;
  }
}

ViewerWindow::~ViewerWindow() { glfwTerminate(); }

void ViewerWindow::setInput(Input input, std::function<bool()> panelWantsMouse) {
  input_ = std::move(input);
  panelWantsMouse_ = std::move(panelWantsMouse);
  glfwSetWindowUserPointer(window_, this);
  glfwGetCursorPos(window_, &cursorX_, &cursorY_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS) static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window))->input_.key(key);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window))->onCursor(x, y);
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
    auto& self = *static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window));
    if (self.panelWantsMouse_()) return;
    int width = 1, height = 1;
    glfwGetWindowSize(window, &width, &height);
    self.input_.scroll(steps, (self.cursorX_ - width / 2.0) / height,
                       (height / 2.0 - self.cursorY_) / height);
  });
}

void ViewerWindow::onCursor(double x, double y) {
  const double dx = x - cursorX_, dy = y - cursorY_;
  cursorX_ = x;
  cursorY_ = y;
  const auto down = [this](int button) { return glfwGetMouseButton(window_, button) == GLFW_PRESS; };
  const bool left = down(GLFW_MOUSE_BUTTON_LEFT), right = down(GLFW_MOUSE_BUTTON_RIGHT);
  if (panelWantsMouse_() || (!left && !right)) return;
  const bool control = glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                       glfwGetKey(window_, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
  int width = 1, height = 1;
  glfwGetWindowSize(window_, &width, &height);
  input_.drag(dx / height, -dy / height, right || control);
}

bool ViewerWindow::shouldClose() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void ViewerWindow::requestClose() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void ViewerWindow::pollEvents() { glfwPollEvents(); }
void ViewerWindow::waitEvents(double seconds) { glfwWaitEventsTimeout(seconds); }
void ViewerWindow::swap() { glfwSwapBuffers(window_); }
void ViewerWindow::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

ViewerWindow::Size ViewerWindow::size() const {
  Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

double ViewerWindow::textScale() const {
  float desktop = 1, unused = 1;
  glfwGetWindowContentScale(window_, &desktop, &unused);
  // A 4K screen whose desktop says nothing of its density still gets texts that can be read. In quarters, so
  // that a window being resized does not rebuild its typeface with every pixel.
  const double large = std::floor(size().height / 1080.0 * 4) / 4;
  return std::clamp(std::max(static_cast<double>(desktop), large), 1.0, 4.0);
}

}  // namespace clothsim
