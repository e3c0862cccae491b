#include "viewer/viewer_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "gl/context.h"
#include "gl/requirements.h"

namespace clothsim {
namespace {

constexpr int ordinaryWidth = 1280, ordinaryHeight = 720;  // of a new window on an ordinary screen [pixels]
constexpr int smallestWidth = 480, smallestHeight = 400;

std::string lastGlfwError() {
  const char* text = nullptr;
  return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? "GLFW gives no reason" : text;
}

// Advice for machines without a display: commands that simulate the same scene.
std::string noWindow(const std::string& reason, const std::string& sceneName) {
  return "No window can be opened: " + reason + "\nThese commands need no screen:\n  clothsim render -f " +
         sceneName +
         " --frames 240 --out clip.mp4     a video, or a picture with --out still.png\n  clothsim run -f " +
         sceneName + " --frames 240 --save last.ply      the simulation alone, as a mesh";
}

// By how much text and windows are larger on a screen of many pixels, where the desktop does not scale: half
// as large again on one of 3840 x 2160. In quarters.
double screenScale() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  return mode == nullptr ? 1 : std::max(1.0, std::floor(4 * mode->height / 1440.0) / 4);
}

// The size of a new window: scaled with the desktop or the screen, but no larger than that.
std::pair<int, int> firstSize() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return {ordinaryWidth, ordinaryHeight};
  float scale = 1, unused = 1;
  glfwGetMonitorContentScale(monitor, &scale, &unused);
  scale = std::max(scale, static_cast<float>(screenScale()));
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  const auto fit = [scale](int wanted, int most) {
    const int scaled = static_cast<int>(static_cast<float>(wanted) * std::max(1.0f, scale));
    return most > 0 ? std::min(scaled, most) : scaled;
  };
  return {fit(ordinaryWidth, width), fit(ordinaryHeight, height)};
}

ViewerWindow& selfOf(GLFWwindow* window) {
  return *static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window));
}

// The names in viewer_keys.h of keys without a letter or a digit.
struct NamedKey {
  const char* name;
  int code;
};
constexpr std::array namedKeys{
    NamedKey{"Space", GLFW_KEY_SPACE}, NamedKey{"Esc", GLFW_KEY_ESCAPE},  NamedKey{"Tab", GLFW_KEY_TAB},
    NamedKey{"Left", GLFW_KEY_LEFT},   NamedKey{"Right", GLFW_KEY_RIGHT}, NamedKey{"F1", GLFW_KEY_F1},
    NamedKey{"F2", GLFW_KEY_F2},       NamedKey{"F3", GLFW_KEY_F3},       NamedKey{"F5", GLFW_KEY_F5}};

// The label of a key. GLFW names keys by their labels on American keyboards, which others do not share.
std::string nameOfKey(int code, int scancode) {
  for (const NamedKey& key : namedKeys)
    if (key.code == code) return key.name;
  const char* printed = glfwGetKeyName(code, scancode);
  if (printed != nullptr && std::string_view(printed) == "+") return "=";  // on other keyboards
  if (printed != nullptr && printed[0] != '\0' && printed[1] == '\0')
    return std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(printed[0]))));
  const bool isLetter = code >= GLFW_KEY_A && code <= GLFW_KEY_Z;
  return isLetter ? std::string(1, static_cast<char>(code)) : "";
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
  for (const int robustness :
       {GLFW_LOSE_CONTEXT_ON_RESET, GLFW_NO_ROBUSTNESS}) {  // some drivers cannot do the first
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
    if (window_ == nullptr) window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  }
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
  installCallbacks();
  lookAtScreen();
  glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
}

ViewerWindow::~ViewerWindow() { glfwTerminate(); }

void ViewerWindow::onButton(int button, int action, int mods) {
  InputEvent event{.kind = InputEvent::Kind::button, .code = button, .action = action, .mods = mods};
  glfwGetCursorPos(window_, &event.x, &event.y);
  queue_.add(event);
  if (button != GLFW_MOUSE_BUTTON_LEFT && button != GLFW_MOUSE_BUTTON_RIGHT) return;
  const Button which = button == GLFW_MOUSE_BUTTON_LEFT ? Button::left : Button::right;
  if (action == GLFW_PRESS && input_.press)
    input_.press(which, cursor(), (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0);
  if (action == GLFW_RELEASE && input_.release) input_.release(which);
}

void ViewerWindow::installCallbacks() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    ViewerWindow& self = selfOf(window);
    self.queue_.add({InputEvent::Kind::key, key, scancode, action, mods});
    if (action == GLFW_RELEASE || !self.input_.key) return;
    self.input_.key({nameOfKey(key, scancode), (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0},
                    action == GLFW_REPEAT);
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int character) {
    selfOf(window).queue_.add({.kind = InputEvent::Kind::character, .code = static_cast<int>(character)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    selfOf(window).onButton(button, action, mods);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    ViewerWindow& self = selfOf(window);
    self.cursor_ = {x, y};
    if (self.input_.move) self.input_.move(self.cursor());
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
    const ViewerWindow& self = selfOf(window);
    if (self.input_.scroll) self.input_.scroll(steps, self.cursor());
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    const ViewerWindow& self = selfOf(window);
    if (self.input_.drop) self.input_.drop({paths, paths + count});
  });
  const auto onChange = [](GLFWwindow* window, int, int) { selfOf(window).lookAtScreen(); };
  glfwSetFramebufferSizeCallback(window_, onChange);
  glfwSetWindowSizeCallback(window_, onChange);
  glfwSetWindowPosCallback(window_, onChange);
  glfwSetWindowContentScaleCallback(window_,
                                    [](GLFWwindow* window, float, float) { selfOf(window).lookAtScreen(); });
}

void ViewerWindow::lookAtScreen() {
  glfwGetFramebufferSize(window_, &pixels_.width, &pixels_.height);
  glfwGetWindowSize(window_, &units_.width, &units_.height);
  float desktop = 1, unused = 1;
  glfwGetWindowContentScale(window_, &desktop, &unused);
  leastTextScale_ = std::max(static_cast<double>(desktop), screenScale());
}

bool ViewerWindow::shouldClose() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE || isInterrupted();
}
void ViewerWindow::requestClose() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void ViewerWindow::pollEvents() { glfwPollEvents(); }
void ViewerWindow::waitEvents(double seconds) { glfwWaitEventsTimeout(seconds); }
void ViewerWindow::swap() { glfwSwapBuffers(window_); }
void ViewerWindow::lendContext() { glfwMakeContextCurrent(nullptr); }
void ViewerWindow::takeContext() { glfwMakeContextCurrent(window_); }
void ViewerWindow::wakeUp() { glfwPostEmptyEvent(); }
void ViewerWindow::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

ViewerWindow::Cursor ViewerWindow::cursor() const {
  if (units_.width <= 0 || units_.height <= 0) return cursor_;
  return {cursor_.x * pixels_.width / units_.width, cursor_.y * pixels_.height / units_.height};
}

bool ViewerWindow::holds(std::string_view key) const {
  for (int code = GLFW_KEY_A; code <= GLFW_KEY_Z; ++code)
    if (glfwGetKey(window_, code) == GLFW_PRESS && nameOfKey(code, 0) == key) return true;
  return false;
}

bool ViewerWindow::holdsShift() const {
  return glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
         glfwGetKey(window_, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
}

bool ViewerWindow::holdsControl() const {
  return glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
         glfwGetKey(window_, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
}

double ViewerWindow::textScale() const {
  // Large windows get larger text where the desktop does not scale. The factor is rounded to quarters, so
  // that the font is not rebuilt for every pixel while a window is resized.
  const double large = std::floor(pixels_.height / 1080.0 * 4) / 4;
  return std::clamp(std::max(leastTextScale_, large), 1.0, 4.0);
}

}  // namespace clothsim
