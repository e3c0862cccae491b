// The frames of a session that can be looked at again: each with all that is needed to go on from there to
// the bit. The oldest ones go first when there is no room for more.
// A frame costs a copy of 32 bytes a particle on the GPU, 28 on the CPU: about as much as half a step of the
// many in it.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "core/shared.h"
#include "scene/scene.h"
#include "session/actions.h"
#include "solver/hand.h"
#include "solver/solver.h"

namespace clothsim {

// Scenes that undo() and redo() lead to; the last one is the next to come.
using SceneStack = std::vector<Shared<Scene>>;

// What a session knows besides the state of the solver.
struct SessionFrame {
  int number = 0;
  int start = 0;  // the number of the frame in which the simulation last began anew
  std::uint64_t step = 0;
  Shared<Scene> scene;
  Hand hand;
  std::vector<MoveCollider> colliderMoves;  // of the next frame
  SceneStack undo, redo;
};

class FrameRing {
 public:
  explicit FrameRing(std::size_t budget) : budget_(budget) {}

  [[nodiscard]] bool isEmpty() const { return entries_.empty(); }
  [[nodiscard]] int oldest() const { return entries_.front().frame.number; }
  [[nodiscard]] int newest() const { return entries_.back().frame.number; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  void setBudget(std::size_t bytes);

  struct Entry {
    SessionFrame frame;
    std::unique_ptr<Snapshot> snapshot;
  };
  // Remembers a frame up to newest() + 1, in the place of what was known of it; one before oldest() is
  // forgotten for good. The last frame is kept whatever the budget.
  void put(const SessionFrame& frame, Solver& solver);
  // The same, without forgetting another one for it: until the next put().
  void putBeyondBudget(const SessionFrame& frame, Solver& solver);
  // From oldest() to newest().
  [[nodiscard]] const Entry& at(int number) const;
  void forgetAfter(int number);

 private:
  // What fell out, if anything.
  std::unique_ptr<Snapshot> makeRoom();
  void place(const SessionFrame& frame, Solver& solver, std::unique_ptr<Snapshot> spare);
  void dropOldest();

  std::deque<Entry> entries_;
  std::size_t budget_, bytes_ = 0;
};

}  // namespace clothsim
