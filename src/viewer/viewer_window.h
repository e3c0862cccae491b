// The window and its OpenGL context, by GLFW. Only the viewer uses it, since glfwInit fails without a
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
    // Called when a key is pressed, and repeatedly while it is held.
    std::function<void(const KeyStroke&, bool repeated)> key;
    std::function<void(Button, Cursor, bool control, bool shift)> press;
    std::function<void(Cursor)> move;  // also without a button
    std::function<void(Button)> release;
    std::function<void(double steps, Cursor)> scroll;
    std::function<void(const std::vector<std::string>& paths)> drop;  // files that were dropped on the window
  };

  // Opens a window with a current OpenGL 4.5 core context. Without a display the error names commands that
  // can simulate this scene. @throws OpenGlError
  ViewerWindow(const std::string& title, const std::string& sceneName);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  // Called from pollEvents and waitEvents.
  void setInput(Input input) { input_ = std::move(input); }

  [[nodiscard]] GLFWwindow* handle() const { return window_; }
  // Keys and clicks for the controls.
  [[nodiscard]] InputQueue& inputQueue() { return queue_; }
  [[nodiscard]] bool shouldClose() const;
  void requestClose();
  void pollEvents();
  void waitEvents(double seconds);  // returns earlier when an event comes
  void swap();
  // The context belongs to one thread at a time: one thread lends it, then another takes it.
  void lendContext();
  void takeContext();
  void wakeUp();  // ends waitEvents() of another thread
  void setTitle(const std::string& title);

  struct Size {
    int width = 0, height = 0;  // pixels; 0 while minimised
    friend bool operator==(const Size&, const Size&) = default;
  };
  [[nodiscard]] Size size() const { return pixels_; }
  [[nodiscard]] Cursor cursor() const;
  // Whether the key of that name (viewer_keys.h) is held now.
  [[nodiscard]] bool holds(std::string_view key) const;
  [[nodiscard]] bool holdsShift() const;
  [[nodiscard]] bool holdsControl() const;
  // The factor by which text is larger than on an ordinary screen. It follows the scale of the desktop, the
  // pixels of the screen and the size of the window.
  [[nodiscard]] double textScale() const;

 private:
  void installCallbacks();
  void lookAtScreen();
  void onButton(int button, int action, int mods);

  GLFWwindow* window_ = nullptr;
  // As events have told: whoever draws asks a hundred times, and each question would wait for the X server.
  Size pixels_, units_;  // of the framebuffer; of the window, which on a scaled desktop are others
  Cursor cursor_;        // [units]
  double leastTextScale_ = 1;
  Input input_;
  InputQueue queue_;
};

}  // namespace clothsim
