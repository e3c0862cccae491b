// The window and its OpenGL context, by GLFW. Only the viewer touches this: glfwInit fails where there is no
// display.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/input_queue.h"
#include "viewer/viewer_keys.h"

struct GLFWwindow;

namespace clothsim {

class ViewerWindow {
 public:
  struct Cursor {
    double x = 0, y = 0;  // pixels of the framebuffer, from the top left
  };
  enum class Button { left, right };
  struct Input {
    // Pressed, or repeated while it is held.
    std::function<void(const KeyStroke&, bool repeated)> key;
    std::function<void(Button, Cursor, bool control, bool shift)> press;
    std::function<void(Cursor)> move;  // also while no button is held
    std::function<void(Button)> release;
    std::function<void(double steps, Cursor)> scroll;
    std::function<void(const std::vector<std::string>& paths)> drop;  // files from another window
  };

  // Opens a window with an OpenGL 4.5 core context, current and ready to use. The message for those without a
  // screen names commands for this scene. @throws OpenGlError
  ViewerWindow(const std::string& title, const std::string& sceneName);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  // Called from pollEvents and waitEvents.
  void setInput(Input input) { input_ = std::move(input); }

  [[nodiscard]] GLFWwindow* handle() const { return window_; }
  // Everything typed and clicked, for the controls.
  [[nodiscard]] InputQueue& inputQueue() { return queue_; }
  [[nodiscard]] bool shouldClose() const;
  void requestClose();
  void pollEvents();
  void waitEvents(double seconds);  // or until something happens
  void swap();
  // The context belongs to one thread at a time: lent by the window's own, taken by another, and back.
  void lendContext();
  void takeContext();
  void wakeUp();  // from another thread: waitEvents ends
  void setTitle(const std::string& title);

  struct Size {
    int width = 0, height = 0;  // pixels; 0 while minimised
  };
  [[nodiscard]] Size size() const;
  [[nodiscard]] Cursor cursor() const;
  // Whether the key of that name (viewer_keys.h) is held now.
  [[nodiscard]] bool holds(std::string_view key) const;
  [[nodiscard]] bool holdsShift() const;
  // By how much texts are to be larger than on an ordinary screen: what the desktop says, or what a large
  // window asks for.
  [[nodiscard]] double textScale() const;

 private:
  void installCallbacks();
  void onButton(int button, int action, int mods);

  GLFWwindow* window_ = nullptr;
  Input input_;
  InputQueue queue_;
};

}  // namespace clothsim
