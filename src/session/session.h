// A simulation with hands on it: everything done to it goes through act(), which records it, and its frames
// are remembered for a while, so that one can look back and go on from there.
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
#include "solver/trouble.h"

namespace clothsim {

inline constexpr std::size_t DEFAULT_SNAPSHOT_BUDGET = std::size_t{256} << 20;  // [bytes]

class Session {
 public:
  // @throws as Simulation
  Session(const Shared<Scene>& scene, const std::string& backend, SolverFactory makeSolver,
          std::size_t snapshotBudget = DEFAULT_SNAPSHOT_BUDGET);

  // To look at, draw and measure. Whoever steps or changes it past the session spoils the recording.
  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const Cuts& cuts() const { return simulation_.solver().cuts(); }
  [[nodiscard]] bool isHolding() const { return now_.hand.hold.has_value(); }  // between Grab and Release
  [[nodiscard]] bool isBlowing() const { return now_.hand.jet.has_value(); }
  [[nodiscard]] const Hand& hand() const { return now_.hand; }  // what is held, where, and the jet
  // Grows whenever simulation().cloth() is another one: by an edit of a field that rebuilds, or seek() across
  // one. Whatever was made of the old cloth (a renderer) is to be made anew.
  [[nodiscard]] std::uint64_t clothGeneration() const { return clothGeneration_; }

  // Acts at once, and goes into the recording; what has no effect (a Release of nothing, a stroke beside the
  // cloth) does not. An EditScene that `continues` the one before it (a slider being dragged) is undone
  // together with it. @throws UsageError for what makes no sense here, SceneError, OpenGlError; nothing has
  // changed then
  void act(const Action& action, bool continues = false);

  // Steps, and remembers the state at the start of each frame. After trouble the state is that of the last
  // frame known to be sound, and the hand has let go; what came after it is forgotten, also by the recording.
  // A frame that an interrupt cuts short is given up.
  [[nodiscard]] std::optional<Trouble> stepFrames(int frames);

  // Called about twenty times a second while frames are being stepped, so that somebody may look after a
  // window; it must not touch the session. When it says false, stepFrames() ends at once: the frame that it
  // was in is given up, and the state is that of the frame before.
  void setPulse(std::function<bool()> pulse) { pulse_ = std::move(pulse); }

  // Of EditScene; each of them acts and is recorded as an EditScene itself. Colliders moved by hand stay
  // where they are.
  [[nodiscard]] bool canUndo() const { return !now_.undo.empty(); }
  [[nodiscard]] bool canRedo() const { return !now_.redo.empty(); }
  void undo();
  void redo();

  // Frames and steps are counted from the start of the session, over all restarts.
  [[nodiscard]] int oldestFrame() const;  // that can still be looked at
  [[nodiscard]] int frame() const { return now_.number; }
  [[nodiscard]] int newestFrame() const;
  // Counted from the last restart before frame(), as a person counts.
  [[nodiscard]] int frameSinceStart() const { return now_.number - now_.start; }
  [[nodiscard]] std::uint64_t step() const { return now_.step; }
  // Shows a remembered frame, oldestFrame() to newestFrame(), as it was when it was left: state, scene, pins,
  // cuts and hands, to the bit. (The hand may hold there: who does not want that acts a Release before
  // stepping.) Stepping or acting there forgets what came later. @throws SceneError, OpenGlError
  void seek(int frame);

  // What is left when its device is lost: what was done up to frame(), and the step of it.
  struct Past {
    Recording recording;
    std::uint64_t step = 0;
  };
  [[nodiscard]] Past past();
  // Another session's, which ended in this one's scene: goes on counting and recording as if this had been
  // that one, and been restarted on this backend. Before anything is stepped.
  void goOnFrom(Past past);

  // The scene at the start, and what was done up to newestFrame().
  [[nodiscard]] const Recording& recording() const { return recording_; }

  [[nodiscard]] std::size_t snapshotBytes() const { return ring_.bytes(); }
  // The frame that was left last is remembered whatever the budget.
  void setSnapshotBudget(std::size_t bytes) { ring_.setBudget(bytes); }

 private:
  // Each returns whether it had an effect.
  bool apply(const EditScene& edit);
  bool apply(const Grab& grab);
  bool apply(const MoveHand& move);
  bool apply(const Release& release);
  bool apply(const SetPin& pin);
  bool apply(const CutStroke& stroke);
  bool apply(const Blow& blow);
  bool apply(const MoveCollider& move);
  bool apply(const SwitchBackend& to);
  bool apply(const Restart& restart);
  void record(const Action& action);
  void changeScene(const Shared<Scene>& scene);
  void rebuild(const Shared<Scene>& scene);
  void goBetween(SceneStack& from, SceneStack& to);
  [[nodiscard]] std::optional<Trouble> stepFrame();
  [[nodiscard]] bool advance(int steps);
  void startColliderMoves();
  void finishColliderMoves();
  void forgetLater();
  void goTo(int frame);

  Simulation simulation_;
  Recording recording_;
  SessionFrame now_;
  FrameRing ring_;
  std::uint64_t clothGeneration_ = 0;
  std::function<bool()> pulse_;
  int stepsAtOnce_ = 1;  // between two looks at the clock, for the pulse
  bool goesOn_ = true;   // as the pulse said
};

}  // namespace clothsim
