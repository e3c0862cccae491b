// Repeats a recording frame by frame, with the same bits on either backend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/recording.h"
#include "session/session.h"

namespace clothsim {

class Replay {
 public:
  // Without `backend` each part runs on the backend that it was recorded on. @throws as Session, and
  // SceneError that names an event that cannot be applied
  Replay(Recording recording, const std::optional<std::string>& backend, SolverFactory makeSolver);

  [[nodiscard]] Session& session() { return session_; }
  // Simulates a frame, then applies the actions recorded at its end. Beyond the end of the recording frames
  // are simulated without any action. @throws as the constructor
  [[nodiscard]] std::optional<Divergence> stepFrame();
  // What is odd about the recording as far as it was repeated, a sentence each: recordings of the viewer have
  // nothing of the kind.
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  void applyDueEvents();

  Recording recording_;
  bool keepsBackend_;
  Session session_;
  std::size_t next_ = 0;  // index of the first event that is not applied yet
  std::size_t late_ = 0;  // events that lie within a frame
  int frames_ = 0;        // simulated
};

}  // namespace clothsim
