#include "session/replay.h"

#include <string>
#include <utility>

#include "core/interrupt.h"

namespace clothsim {

Replay::Replay(Recording recording, const std::optional<std::string>& backend, SolverFactory makeSolver)
    : recording_(std::move(recording)),
      keepsBackend_(backend.has_value()),
      session_(recording_.scene, backend.value_or(recording_.backend), makeSolver, 0) {
  applyDueEvents();
}

std::optional<Divergence> Replay::stepFrame() {
  const std::optional<Divergence> divergence = session_.stepFrames(1);
  stopIfInterrupted();
  if (divergence) return divergence;
  ++frames_;
  applyDueEvents();
  return std::nullopt;
}

std::vector<std::string> Replay::remarks() const {
  const std::size_t left = recording_.events.size() - next_;
  std::vector<std::string> remarks;
  if (late_ > 0)
    remarks.push_back(recording_.source + ": " + std::to_string(late_) +
                      " of its actions lie within a frame and were done at its end; actions count steps, so "
                      "that other solver.simulation_steps shift them");
  if (left > 0 && frames_ >= recording_.frames)
    remarks.push_back(recording_.source + ": " + std::to_string(left) + " of its actions come after its " +
                      std::to_string(recording_.frames) + " frames and were not done");
  return remarks;
}

void Replay::applyDueEvents() {
  for (; next_ < recording_.events.size() && recording_.events[next_].step <= session_.step(); ++next_) {
    const Action& action = recording_.events[next_].action;
    if (recording_.events[next_].step < session_.step()) ++late_;
    if (keepsBackend_ && std::holds_alternative<SwitchBackend>(action)) continue;
    recording_.within(next_, [&] { session_.act(action); });
  }
}

}  // namespace clothsim
