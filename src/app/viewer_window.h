// The window and its OpenGL context, by GLFW. Only the viewer touches this: glfwInit fails where there is no
// display.
#pragma once

#include <functional>
#include <string>

struct GLFWwindow;

namespace clothsim {

class ViewerWindow {
 public:
  struct Input {
    std::function<void(int glfwKey)> key;  // pressed, not repeated
    std::function<void(double dx, double dy, bool pan)>
        drag;  // as fractions of the window's height, y upwards
    std::function<void(double steps, double x, double y)>
        scroll;  // at x, y from the centre, in window heights, y upwards
  };

  // Opens a window with an OpenGL 4.5 core context, current and ready to use. The message for those without a
  // screen names commands for this scene. @throws OpenGlError
  ViewerWindow(const std::string& title, const std::string& sceneName);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  // Called from pollEvents and waitEvents; `wantsMouse` says that a panel takes the mouse for itself.
  void setInput(Input input, std::function<bool()> panelWantsMouse);

  [[nodiscard]] GLFWwindow* handle() const { return window_; }
  [[nodiscard]] bool shouldClose() const;
  void requestClose();
  void pollEvents();
  void waitEvents(double seconds);  // or until something happens
  void swap();
  void setTitle(const std::string& title);

  struct Size {
    int width = 0, height = 0;  // pixels; 0 while minimised
  };
  [[nodiscard]] Size size() const;
  // By how much texts are to be larger than on an ordinary screen: what the desktop says, or what a large
  // window asks for.
  [[nodiscard]] double textScale() const;

 private:
  void onCursor(double x, double y);

  GLFWwindow* window_ = nullptr;
  Input input_;
  std::function<bool()> panelWantsMouse_;
  double cursorX_ = 0, cursorY_ = 0;
};

}  // namespace clothsim
