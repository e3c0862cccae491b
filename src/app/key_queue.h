// What is typed between two frames of the window, for a user interface that looks at keys once a frame: a key
// that was pressed and let go within a frame must be seen pressed in one and let go in the next.
#pragma once

#include <deque>
#include <vector>

namespace clothsim {

struct TypedKey {
  bool isCharacter = false;
  unsigned int character = 0;                       // or else
  int key = 0, scancode = 0, action = 0, mods = 0;  // as GLFW says it
};

class KeyQueue {
 public:
  void add(const TypedKey& typed) { waiting_.push_back(typed); }
  [[nodiscard]] bool isEmpty() const { return waiting_.empty(); }
  // What one frame is told, in order: everything up to the first key that has changed in it before.
  [[nodiscard]] std::vector<TypedKey> takeFrame() {
    std::vector<TypedKey> taken;
    const auto hasChanged = [&](const TypedKey& next) {
      for (const TypedKey& typed : taken)
        if (!typed.isCharacter && typed.key == next.key && typed.action != next.action) return true;
      return false;
    };
    while (!waiting_.empty() && (waiting_.front().isCharacter || !hasChanged(waiting_.front()))) {
      taken.push_back(waiting_.front());
      waiting_.pop_front();
    }
    return taken;
  }

 private:
  std::deque<TypedKey> waiting_;
};

}  // namespace clothsim
