// Keys and clicks between two frames of the window, for a user interface that looks at their state once a
// frame: what was pressed and let go within a frame must be seen pressed in one and let go in the next, and a
// click where it was, together with Ctrl or Shift as they were held then. Text needs no such care: it arrives
// as characters.
#pragma once

#include <deque>
#include <vector>

namespace clothsim {

struct InputEvent {
  enum class Kind { key, character, button };
  Kind kind = Kind::key;
  int code = 0;  // of the key, the character or the button, as GLFW numbers them
  int scancode = 0, action = 0, mods = 0;
  double x = 0, y = 0;  // of a button: where the cursor was, in units of the window
};

class InputQueue {
 public:
  void add(const InputEvent& event) {
    const bool isText = event.kind == InputEvent::Kind::key && event.code < endOfPrintableKeys &&
                        event.action != letGo && (event.mods & control) == 0;
    if (!isText) waiting_.push_back(event);
  }
  [[nodiscard]] bool isEmpty() const { return waiting_.empty(); }

  // What one frame is told, in order.
  [[nodiscard]] std::vector<InputEvent> takeFrame() {
    std::vector<InputEvent> taken;
    while (!waiting_.empty() && !mustWait(waiting_.front(), taken)) {
      taken.push_back(waiting_.front());
      waiting_.pop_front();
    }
    return taken;
  }

 private:
  static constexpr int letGo = 0, control = 2, endOfPrintableKeys = 256, firstModifier = 340;  // GLFW's

  static bool mustWait(const InputEvent& next, const std::vector<InputEvent>& before) {
    if (next.kind == InputEvent::Kind::character) return false;
    for (const InputEvent& event : before) {
      if (event.kind == next.kind && event.code == next.code && event.action != next.action) return true;
      if (event.kind == InputEvent::Kind::button && event.action != letGo &&
          next.kind == InputEvent::Kind::key && next.code >= firstModifier)
        return true;
    }
    return false;
  }

  std::deque<InputEvent> waiting_;
};

}  // namespace clothsim
