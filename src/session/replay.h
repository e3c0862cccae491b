// A recording done again, frame by frame: the same bits on either backend.
#pragma once

#include <optional>
#include <string>

#include "session/recording.h"
#include "session/session.h"

namespace clothsim {

class Replay {
 public:
  // On the recording's own backends, changing as it did; or all of it on `backend`. @throws as Session, and
  // SceneError that names the event when it makes no sense in its place
  Replay(Recording recording, const std::optional<std::string>& backend, SolverFactory makeSolver);

  [[nodiscard]] Session& session() { return session_; }
  // Steps a frame, then does what was done at its end. Goes on without hands where the recording ends.
  // @throws likewise
  [[nodiscard]] std::optional<Trouble> stepFrame();

 private:
  void actOutDue();

  Recording recording_;
  bool keepsBackend_;
  Session session_;
  std::size_t next_ = 0;  // event
};

}  // namespace clothsim
