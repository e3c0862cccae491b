// A simulation with hands on it: everything done to it goes through act(), which records it, and its frames
// are remembered for a while, so that one can look back and go on from there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/actions.h"
#include "app/recording.h"
#include "app/simulation.h"
#include "solver/trouble.h"

namespace clothsim {

inline constexpr std::size_t DEFAULT_SNAPSHOT_BUDGET = std::size_t{256} << 20;  // [bytes]

class Session {
 public:
  // @throws as Simulation
  Session(const Scene& scene, const std::string& backend,
          std::size_t snapshotBudget = DEFAULT_SNAPSHOT_BUDGET);

  // To look at, draw and measure. Whoever steps or changes it past the session spoils the recording.
  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const Cuts& cuts() const;
  [[nodiscard]] bool isHolding() const;  // between Grab and Release
  [[nodiscard]] bool isBlowing() const;
  // Grows whenever simulation().cloth() is another one: by an edit of a field that rebuilds, or seek() across
  // one. Whatever was made of the old cloth (a renderer) is to be made anew.
  [[nodiscard]] std::uint64_t clothGeneration() const { return clothGeneration_; }

  // Acts at once, and goes into the recording. An EditScene that `continues` the one before it (a slider
  // being dragged) is undone together with it. @throws SceneError, UsageError, OpenGlError; nothing has
  // changed then
  void act(const Action& action, bool continues = false);

  // Steps, and remembers the state at the start of each frame. After trouble the state is the last frame's
  // that is known to be sound, and the hand has let go; what came after it is forgotten, also by the
  // recording.
  [[nodiscard]] std::optional<Trouble> stepFrames(int frames);

  // Of EditScene; each of them acts and is recorded as an EditScene itself. Colliders moved by hand stay
  // where they are.
  [[nodiscard]] bool canUndo() const { return !undo_.empty(); }
  [[nodiscard]] bool canRedo() const { return !redo_.empty(); }
  void undo();
  void redo();

  // Frames are counted from the start of the session, over all restarts.
  [[nodiscard]] int oldestFrame() const;  // that can still be looked at
  [[nodiscard]] int frame() const { return frame_; }
  [[nodiscard]] int newestFrame() const;
  // Shows a remembered frame as it was when it was left: state, scene, hand, pins and cuts, to the bit.
  // Stepping or acting there forgets what came later. Only frames from oldestFrame() to newestFrame().
  void seek(int frame);

  // The scene at the start, and what was done up to newestFrame().
  [[nodiscard]] const Recording& recording() const { return recording_; }

  [[nodiscard]] std::size_t snapshotBytes() const;
  void setSnapshotBudget(std::size_t bytes);

 private:
  void apply(const Action& action, bool continues);
  void record(const Action& action);
  void edit(const Scene& scene);

  Simulation simulation_;
  Recording recording_;
  int frame_ = 0;
  std::uint64_t step_ = 0;  // since the start of the session
  std::uint64_t clothGeneration_ = 0;
  std::vector<Scene> undo_, redo_;  // the last one is the next to come
};

}  // namespace clothsim
