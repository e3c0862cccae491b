// Queues keys and clicks for Dear ImGui, which reads their state once a frame. A key that is pressed and
// released within a frame is reported as pressed in one frame and as released in the next. A click is
// reported at its place and with Ctrl and Shift as they were then. Text needs no queue, because it arrives as
// characters.
#pragma once

#include <deque>
#include <vector>

namespace clothsim {

struct InputEvent {
  enum class Kind { key, character, button };
  Kind kind = Kind::key;
  int code = 0;  // of the key, character or button, by GLFW's numbers
  int scancode = 0, action = 0, mods = 0;
  double x = 0, y = 0;  // of the cursor when a button was pressed or released, in units of the window
};

class InputQueue {
 public:
  void add(const InputEvent& event) {
    const bool isText = event.kind == InputEvent::Kind::key && event.code < endOfPrintableKeys &&
                        event.action != letGo && (event.mods & control) == 0;
    if (!isText) waiting_.push_back(event);
  }
  [[nodiscard]] bool isEmpty() const { return waiting_.empty(); }

  // The events to report in the next frame, in order.
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
