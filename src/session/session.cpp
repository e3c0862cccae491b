#include "session/session.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "core/interrupt.h"
#include "scene/moved_collider.h"
#include "session/action_checks.h"
#include "session/carry_over.h"
#include "session/moved_pins.h"

namespace clothsim {

Session::Session(const Shared<Scene>& scene, const std::string& backend, SolverFactory makeSolver,
                 std::size_t snapshotBudget)
    : simulation_(scene, backend, makeSolver), ring_(snapshotBudget) {
  recording_.scene = scene;
  recording_.backend = backend;
  now_.scene = scene;
  simulation_.solver().convertVelocities();  // the bits must not depend on when the state is first read
}

namespace {

// Whether nothing is left of the first scene once another one of this kind has followed.
bool leavesNoTrace(const Scene& before, const Scene& after) {
  return !needsRebuild(before, after) && before.solver == after.solver &&
         before.colliders.size() == after.colliders.size();
}

}  // namespace

void Session::act(const Action& action, bool continues) {
  checkAction(action, simulation_.cloth(), simulation_.scene());
  const Shared<Scene> before = now_.scene;
  if (!std::visit([this](const auto& now) { return apply(now); }, action)) return;
  simulation_.touch();
  if (std::holds_alternative<EditScene>(action) || std::holds_alternative<MoveCollider>(action) ||
      std::holds_alternative<TurnCollider>(action)) {
    if (!continues || now_.undo.empty()) now_.undo.push_back(before);
    now_.redo.clear();
  }
  const auto* edit = std::get_if<EditScene>(&action);
  if (edit != nullptr && continues && takesPlaceOfLast(*edit, before)) {
    recording_.events.back().action = action;
    return;
  }
  record(action);
  if (edit != nullptr) beforeLastEdit_ = before;
}

// A dragged slider edits the scene with every picture, hundreds of times within a paused frame: the recording
// needs the last one alone. Where that is as before the drag, a replay would see no edit at all.
bool Session::takesPlaceOfLast(const EditScene& edit, const Shared<Scene>& before) {
  dropLaterFrames();
  if (!beforeLastEdit_ || recording_.events.back().step != now_.step) return false;
  const Scene &first = **beforeLastEdit_, &last = *edit.scene;
  return leavesNoTrace(first, *before) && leavesNoTrace(*before, last) && first != last;
}

// An action in an earlier frame drops the later ones.
void Session::record(const Action& action) {
  dropLaterFrames();
  recording_.events.push_back({now_.step, action});
  beforeLastEdit_.reset();
}

bool Session::apply(const EditScene& edit) {
  changeScene(edit.scene);
  return true;
}

bool Session::apply(const Grab& grab) {
  Solver& solver = simulation_.solver();
  now_.interaction.grab = makeGrabSpring(
      simulation_.cloth(), grab.particle, grab.strength, grab.radius,
      [&](std::uint32_t first, std::uint32_t count) { return solver.positions(first, count); });
  apply(MoveHand{grab.target});
  return true;
}

bool Session::apply(const MoveHand& move) {
  if (!now_.interaction.grab) return false;
  moveTo(*now_.interaction.grab, move.target, simulation_.solver().stepIndex(),
         simulation_.scene().solver.simulationSteps);
  simulation_.solver().setInteraction(now_.interaction);
  return true;
}

bool Session::apply(const Release&) {
  if (!now_.interaction.grab) return false;
  now_.interaction.grab.reset();
  simulation_.solver().setInteraction(now_.interaction);
  return true;
}

bool Session::apply(const SetPin& pin) {
  simulation_.solver().setPin(pin.particle, pin.pinned);
  return true;
}

bool Session::apply(const CutStroke& stroke) {
  Cuts cuts = simulation_.solver().cuts();
  if (!cutAlong(cuts, simulation_.cloth(), stroke.piece, stroke.from, stroke.to)) return false;
  simulation_.solver().setCuts(cuts);
  return true;
}

bool Session::apply(const Blow& blow) {
  const bool blows = blow.speed != 0;
  if (!blows && !now_.interaction.jet) return false;
  now_.interaction.jet.reset();
  if (blows) now_.interaction.jet = Jet{blow.origin, blow.direction, blow.speed, blow.radius};
  simulation_.solver().setInteraction(now_.interaction);
  return true;
}

// In the next frame.
ColliderMove& Session::moveOf(std::size_t collider) {
  std::vector<ColliderMove>& moves = now_.colliderMoves;
  const auto found = std::ranges::find(moves, collider, &ColliderMove::collider);
  return found != moves.end() ? *found : moves.emplace_back(ColliderMove{collider, std::nullopt});
}

bool Session::apply(const MoveCollider& move) {
  moveOf(move.collider).position = move.position;
  return true;
}

bool Session::apply(const TurnCollider& turn) {
  std::optional<Matrix3>& whole = moveOf(turn.collider).turn;
  whole = product(rotationMatrix(turn.turn), whole.value_or(identityMatrix));
  return true;
}

bool Session::apply(const SwitchBackend& to) {
  simulation_.switchBackend(to.backend);
  ring_.freeDropped();
  simulation_.solver().setInteraction(now_.interaction);
  return true;
}

bool Session::apply(const Restart&) {
  now_.interaction = {};
  now_.colliderMoves.clear();
  simulation_.solver().setInteraction(now_.interaction);
  simulation_.restart();
  simulation_.solver().convertVelocities();
  now_.start = now_.number;
  return true;
}

void Session::changeScene(const Shared<Scene>& scene) {
  if (needsRebuild(simulation_.scene(), *scene))
    rebuild(scene);
  else
    simulation_.configure(scene);
  simulation_.solver().convertVelocities();
  // The edit may have removed a collider that was to be moved.
  std::erase_if(now_.colliderMoves,
                [&](const ColliderMove& move) { return move.collider >= scene->colliders.size(); });
  now_.scene = scene;
}

void Session::rebuild(const Shared<Scene>& scene) {
  const Shared<Cloth> before = simulation_.sharedCloth();
  const State state = simulation_.solver().state();
  simulation_.rebuild(scene);
  ++clothGeneration_;
  Solver& solver = simulation_.solver();
  if (haveSameLattice(*before, simulation_.cloth())) {
    solver.setState(carriedOver(state, *before, simulation_.cloth()));
    solver.setInteraction(now_.interaction);
  } else {
    now_.interaction = {};
    now_.start = now_.number;
    for (const SetPin& pin : pinsByHand(state, *before, simulation_.cloth()))
      solver.setPin(pin.particle, pin.pinned);
  }
}

void Session::undo() { goBetween(now_.undo, now_.redo); }
void Session::redo() { goBetween(now_.redo, now_.undo); }

void Session::goBetween(SceneStack& from, SceneStack& to) {
  if (from.empty()) return;
  const Shared<Scene> before = now_.scene;
  changeScene(withHandsOf(*before, from.back()));
  record(EditScene{now_.scene});
  from.pop_back();
  to.push_back(before);
  simulation_.touch();
}

std::optional<Divergence> Session::stepFrames(int frames) {
  if (frames > 0) dropLaterFrames();
  isContinued_ = true;
  for (int i = 0; i < frames && isContinued_; ++i)
    if (const std::optional<Divergence> divergence = stepFrame()) return divergence;
  return std::nullopt;
}

// Returns false when the poll has asked to stop.
bool Session::advance(int steps) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds pollTime{50};
  Solver& solver = simulation_.solver();
  if (!poll_) {
    solver.step(steps);
    return true;
  }
  Clock::time_point lastPoll = Clock::now();
  for (int done = 0; done < steps && isContinued_;) {
    const int count = std::min(stepsAtOnce_, steps - done);
    const Clock::time_point start = Clock::now();
    solver.step(count);
    solver.finish();
    const Clock::time_point end = Clock::now();
    done += count;
    if (end - start > pollTime)
      stepsAtOnce_ = std::max(1, count / 2);
    else if (end - start < pollTime / 4 && count == stepsAtOnce_ && stepsAtOnce_ < 1 << 20)
      stepsAtOnce_ *= 2;
    // Counted over several batches: single batches may stay shorter than the interval.
    if (end - lastPoll > pollTime / 2) {
      isContinued_ = poll_();
      lastPoll = end;
    }
  }
  return isContinued_;
}

std::optional<Divergence> Session::stepFrame() {
  ring_.put(now_, simulation_.solver());
  startColliderMoves();
  const int steps = simulation_.scene().solver.simulationSteps;
  if (!advance(steps) || isInterrupted()) {
    goTo(now_.number);
    return std::nullopt;
  }
  if (const std::optional<Divergence> divergence = simulation_.solver().divergence()) {
    goTo(now_.number);
    if (isGrabbing()) act(Release{});
    if (isBlowing()) act(Blow{});
    return divergence;
  }
  finishColliderMoves();
  simulation_.touch();
  now_.step += static_cast<std::uint64_t>(steps);
  recording_.frames = ++now_.number;
  return std::nullopt;
}

void Session::startColliderMoves() {
  if (now_.colliderMoves.empty()) return;
  Scene scene = *now_.scene;
  const double frame = 1 / scene.solver.framesPerSec, start = simulation_.time();
  for (const ColliderMove& move : now_.colliderMoves)
    scene = withColliderOnItsWay(std::move(scene), move, start, start + frame);
  simulation_.configure(std::move(scene));
}

void Session::finishColliderMoves() {
  if (now_.colliderMoves.empty()) return;
  const double time = simulation_.time();
  Scene moved = *now_.scene;
  for (const ColliderMove& move : now_.colliderMoves)
    if (move.collider < moved.colliders.size()) moved = withColliderMoved(std::move(moved), move, time);
  now_.scene = Shared<Scene>(std::move(moved));
  simulation_.configure(now_.scene);
  now_.colliderMoves.clear();
}

Session::Past Session::past() {
  dropLaterFrames();
  return {recording_, now_.step};
}

void Session::goOnFrom(Past past) {
  recording_ = std::move(past.recording);
  now_.number = now_.start = recording_.frames;
  now_.step = past.step;
  record(SwitchBackend{simulation_.solver().backend()});
  record(Restart{});
}

int Session::oldestFrame() const {
  return ring_.isEmpty() ? now_.number : std::min(ring_.oldest(), now_.number);
}
int Session::newestFrame() const {
  return ring_.isEmpty() ? now_.number : std::max(ring_.newest(), now_.number);
}

void Session::dropLaterFrames() {
  if (now_.number == newestFrame()) return;
  ring_.forgetAfter(now_.number, simulation_.solver());
  const auto dropped =
      std::erase_if(recording_.events, [&](const Recording::Event& event) { return event.step > now_.step; });
  if (dropped > 0) beforeLastEdit_.reset();
  recording_.frames = now_.number;
}

void Session::seek(int frame) {
  assert(frame >= oldestFrame() && frame <= newestFrame() && "only frames that are remembered");
  if (frame == now_.number) return;
  ring_.putBeyondBudget(now_, simulation_.solver());
  goTo(std::clamp(frame, ring_.oldest(), ring_.newest()));
}

void Session::goTo(int frame) {
  const FrameRing::Entry& entry = ring_.at(frame);
  const Shared<Scene>& scene = entry.frame.scene;
  if (needsRebuild(simulation_.scene(), *scene)) {
    simulation_.rebuild(scene);
    ++clothGeneration_;
  } else if (scene != simulation_.sharedScene()) {
    simulation_.configure(scene);
  }
  simulation_.solver().restore(*entry.snapshot);
  simulation_.solver().setInteraction(entry.frame.interaction);
  simulation_.touch();
  now_ = entry.frame;
}

}  // namespace clothsim
