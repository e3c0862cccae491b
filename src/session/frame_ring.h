// A ring buffer of past frames. Each holds all that is needed to continue from it with the same bits. When
// the memory budget is used up, the oldest frames are dropped. To store a frame takes about half the time of
// a step: the copy has 32 bytes a particle on the GPU and 28 on the CPU, in implicit steps 16 more where
// there are colliders, and about 50 for each pair of parts that touch.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "core/shared.h"
#include "scene/moved_collider.h"
#include "scene/scene.h"
#include "solver/interaction.h"
#include "solver/solver.h"

namespace clothsim {

// The scenes that undo() or redo() return to. The last one is the next.
using SceneStack = std::vector<Shared<Scene>>;

// What a session holds besides the state of the solver.
struct SessionFrame {
  int number = 0;
  int start = 0;  // number of the frame in which the simulation was last restarted
  std::uint64_t step = 0;
  Shared<Scene> scene;
  Interaction interaction;
  std::vector<ColliderMove> colliderMoves;  // to be done in the next frame
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
  // Stores a frame and replaces what was stored under its number, which is at most newest() + 1. A frame
  // before oldest() is not stored. The newest frame is kept whatever the budget.
  void put(const SessionFrame& frame, Solver& solver);
  // The same, but no frame is dropped for it until the next put().
  void putBeyondBudget(const SessionFrame& frame, Solver& solver);
  // `number` is from oldest() to newest().
  [[nodiscard]] const Entry& at(int number) const;
  void forgetAfter(int number, Solver& solver);
  // Snapshots on the GPU that a session of the CPU backend has dropped wait here for the thread that has the
  // context.
  void freeDropped() { dropped_.clear(); }

 private:
  // Drops frames until another one fits. Returns a snapshot whose memory can be reused, if there is one.
  std::unique_ptr<Snapshot> makeRoom(Solver& solver);
  void place(const SessionFrame& frame, Solver& solver, std::unique_ptr<Snapshot> spare);
  void dropOldest();
  // What may be freed or used again where the solver computes; keeps anything else.
  std::unique_ptr<Snapshot> spareFor(Solver& solver, std::unique_ptr<Snapshot> snapshot);

  std::deque<Entry> entries_;
  std::vector<std::unique_ptr<Snapshot>> dropped_;
  std::size_t budget_, bytes_ = 0;
};

}  // namespace clothsim
