#include "session/replay.h"

#include <string>
#include <utility>

#include "core/error.h"
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
  if (!divergence) applyDueEvents();
  return divergence;
}

void Replay::applyDueEvents() {
  for (; next_ < recording_.events.size() && recording_.events[next_].step <= session_.step(); ++next_) {
    const Action& action = recording_.events[next_].action;
    if (keepsBackend_ && std::holds_alternative<SwitchBackend>(action)) continue;
    try {
      session_.act(action);
    } catch (const UsageError& error) {
      throw SceneError(recording_.source + ": events." + std::to_string(next_) + ": " + error.what());
    }
  }
}

}  // namespace clothsim
