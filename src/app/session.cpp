#include "app/session.h"

#include <cassert>
#include <utility>

namespace clothsim {
namespace {

// Everything but what the solvers take live.
bool needsRebuild(const Scene& before, const Scene& after) {
  if (before.cloths.size() != after.cloths.size()) return true;
  for (std::size_t i = 0; i < before.cloths.size(); ++i) {
    ClothSettings cloth = before.cloths[i];
    cloth.damping = after.cloths[i].damping;
    cloth.pinMotion = after.cloths[i].pinMotion;
    if (cloth != after.cloths[i]) return true;
  }
  return false;
}

template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

}  // namespace

Session::Session(const Scene& scene, const std::string& backend, std::size_t) : simulation_(scene, backend) {
  recording_.scene = scene;
  recording_.backend = backend;
}

const Cuts& Session::cuts() const {
  static const Cuts none;
  return none;
}
bool Session::isHolding() const { return false; }
bool Session::isBlowing() const { return false; }

void Session::record(const Action& action) { recording_.events.push_back({step_, action}); }

void Session::act(const Action& action, bool continues) {
  apply(action, continues);
  record(action);
}

void Session::apply(const Action& action, bool continues) {
  std::visit(Overloaded{[&](const EditScene& edit_) {
                          const Scene before = simulation_.scene();
                          edit(edit_.scene);
                          if (!continues || undo_.empty()) undo_.push_back(before);
                          redo_.clear();
                        },
                        [&](const SwitchBackend& to) { simulation_.switchBackend(to.backend); },
                        [&](const Restart&) { simulation_.restart(); },
                        [&](const SetPin& pin) {
                          simulation_.solver().setPin(pin.particle, pin.pinned);
                          simulation_.touch();
                        },
                        [](const auto&) { /* not yet */ }},
             action);
}

void Session::edit(const Scene& scene) {
  if (needsRebuild(simulation_.scene(), scene)) {
    simulation_.rebuild(scene);
    ++clothGeneration_;
  } else {
    simulation_.configure(scene);
  }
}

std::optional<Trouble> Session::stepFrames(int frames) {
  for (int i = 0; i < frames; ++i) {
    simulation_.stepFrame();
    if (const std::optional<Trouble> trouble = simulation_.checkFrame()) return trouble;
    ++frame_;
    step_ += static_cast<std::uint64_t>(simulation_.scene().solver.simulationSteps);
    recording_.frames = frame_;
  }
  return std::nullopt;
}

void Session::undo() {
  if (undo_.empty()) return;
  const Scene before = simulation_.scene(), scene = std::move(undo_.back());
  undo_.pop_back();
  edit(scene);
  record(EditScene{scene});
  redo_.push_back(before);
}

void Session::redo() {
  if (redo_.empty()) return;
  const Scene before = simulation_.scene(), scene = std::move(redo_.back());
  redo_.pop_back();
  edit(scene);
  record(EditScene{scene});
  undo_.push_back(before);
}

int Session::oldestFrame() const { return frame_; }
int Session::newestFrame() const { return frame_; }
void Session::seek(int frame) {
  assert(frame == frame_ && "not yet");
  (void)frame;
}
std::size_t Session::snapshotBytes() const { return 0; }
void Session::setSnapshotBudget(std::size_t) {}

}  // namespace clothsim
