// A simulation that a user acts on. Every action goes through act(), which records it. Past frames are kept
// within a memory budget: one can look back and continue from there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "session/actions.h"
#include "session/frame_ring.h"
#include "session/recording.h"
#include "simulation/simulation.h"
#include "solver/divergence.h"

namespace clothsim {

inline constexpr std::size_t DEFAULT_SNAPSHOT_BUDGET = std::size_t{256} << 20;  // [bytes]

class Session {
 public:
  // @throws as Simulation
  Session(const Shared<Scene>& scene, const std::string& backend, SolverFactory makeSolver,
          std::size_t snapshotBudget = DEFAULT_SNAPSHOT_BUDGET);

  // To be drawn and measured. Steps and changes that bypass the session are missing in the recording.
  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const Cuts& cuts() const { return simulation_.solver().cuts(); }
  [[nodiscard]] bool isGrabbing() const {
    return now_.interaction.grab.has_value();
  }  // between a Grab and its Release
  [[nodiscard]] bool isBlowing() const { return now_.interaction.jet.has_value(); }
  [[nodiscard]] const Interaction& interaction() const { return now_.interaction; }  // the Grab and the jet
  // Grows whenever simulation() gets another cloth: by an edit that rebuilds it, or by seek() across such an
  // edit.
  [[nodiscard]] std::uint64_t clothGeneration() const { return clothGeneration_; }

  // Applies an action now and records it, unless it has no effect: a Release without a Grab, a cut beside the
  // cloth. What `continues` the edit or the move before it, as while a slider is dragged, is undone together
  // with that one, and may take its place in the recording. @throws UsageError for an action that is
  // impossible now, SceneError, OpenGlError; then nothing has changed
  void act(const Action& action, bool continues = false);

  // Simulates frames and stores the start of each. After divergence the state is that of the last sound
  // frame; later frames are dropped, also from the recording, and the Grab and the jet end. A frame that an
  // interrupt cuts short is dropped.
  [[nodiscard]] std::optional<Divergence> stepFrames(int frames);

  // `poll` is called about twenty times a second during stepFrames(), for example to process the events of a
  // window. It must not use the session. When it returns false, stepFrames() drops the current frame and
  // returns; the state is that of the frame before.
  void setPoll(std::function<bool()> poll) { poll_ = std::move(poll); }

  // Undo and redo actions that edit the scene, or that move or turn a collider: it jumps back. Each is
  // recorded as an EditScene.
  [[nodiscard]] bool canUndo() const { return !now_.undo.empty(); }
  [[nodiscard]] bool canRedo() const { return !now_.redo.empty(); }
  void undo();
  void redo();

  // Frames and steps are counted from the start of the session; a restart does not reset the counters.
  [[nodiscard]] int oldestFrame() const;  // of those that are stored
  [[nodiscard]] int frame() const { return now_.number; }
  [[nodiscard]] int newestFrame() const;
  // The number of frames since the last restart before frame().
  [[nodiscard]] int frameSinceStart() const { return now_.number - now_.start; }
  [[nodiscard]] std::uint64_t step() const { return now_.step; }
  // Goes to a stored frame, oldestFrame() to newestFrame(), with the state, scene, pins, cuts and the Grab
  // that it had. To step or act there drops all later frames. @throws SceneError, OpenGlError
  void seek(int frame);

  // The recording up to frame() and the number of its steps: what is left when the device is lost.
  struct Past {
    Recording recording;
    std::uint64_t step = 0;
  };
  [[nodiscard]] Past past();
  // Continues the counters and the recording of another session, which ended with this one's scene, as if
  // that session had switched to this backend and restarted. To be called before the first step.
  void goOnFrom(Past past);

  // The scene at the start, and the actions up to newestFrame().
  [[nodiscard]] const Recording& recording() const { return recording_; }

  [[nodiscard]] std::size_t snapshotBytes() const { return ring_.bytes(); }
  // Frees memory of the GPU that stepping on the CPU backend has left over. To be called where the context
  // is.
  void freeDropped() { ring_.freeDropped(); }
  // The newest stored frame is kept whatever the budget.
  void setSnapshotBudget(std::size_t bytes) { ring_.setBudget(bytes); }

 private:
  // Each returns whether the action had an effect.
  bool apply(const EditScene& edit);
  bool apply(const Grab& grab);
  bool apply(const MoveHand& move);
  bool apply(const Release& release);
  bool apply(const SetPin& pin);
  bool apply(const CutStroke& stroke);
  bool apply(const Blow& blow);
  bool apply(const MoveCollider& move);
  bool apply(const TurnCollider& turn);
  bool apply(const SwitchBackend& to);
  bool apply(const Restart& restart);
  [[nodiscard]] bool takesPlaceOfLast(const EditScene& edit, const Shared<Scene>& before);
  void record(const Action& action);
  void changeScene(const Shared<Scene>& scene);
  void rebuild(const Shared<Scene>& scene);
  void goBetween(SceneStack& from, SceneStack& to);
  [[nodiscard]] std::optional<Divergence> stepFrame();
  [[nodiscard]] bool advance(int steps);
  [[nodiscard]] ColliderMove& moveOf(std::size_t collider);
  void startColliderMoves();
  void finishColliderMoves();
  void dropLaterFrames();
  void goTo(int frame);

  Simulation simulation_;
  Recording recording_;
  std::optional<Shared<Scene>> beforeLastEdit_;  // where the last event is an edit by act()
  SessionFrame now_;
  FrameRing ring_;
  std::uint64_t clothGeneration_ = 0;
  std::function<bool()> poll_;
  int stepsAtOnce_ = 1;      // between two readings of the clock
  bool isContinued_ = true;  // as poll_ last returned
};

}  // namespace clothsim
