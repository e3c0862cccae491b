// The files that a run writes: states, sequences, pictures, films and the trace.
#pragma once

#include <string>
#include <vector>

#include "commands/commands.h"
#include "commands/saved_pictures.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "simulation/run_summary.h"
#include "simulation/saved_files.h"
#include "simulation/trace.h"

namespace clothsim {

// Whether a file of that name, or its frames, have the number that --first-frame sets.
[[nodiscard]] bool numbersFrames(const std::string& save);
// Whether one file of that name holds many frames.
[[nodiscard]] bool holdsFrames(const std::string& save);

// @throws UsageError for a name of `flag` with a number where one file holds all frames, or with one that
// other programs understand
void checkFrameNumber(const std::string& flag, const std::string& name);

// For messages of a command that ends after `frame`, before its last: which of the files hold what there was
// up to then, and which are missing, since they are of the last frame. It begins with a line end.
[[nodiscard]] std::string earlyEndText(const std::vector<std::string>& names, int frame,
                                       const std::string& trace = "");

// How a command that simulates ends after an interrupt. `finish` finishes its files, and returns what is said
// of them. @throws Interrupted always
template <class Finish>
[[noreturn]] void stopInterrupted(int frame, int frames, Finish finish) {
  finishAfterInterrupt();
  throw Interrupted("interrupted after frame " + std::to_string(frame) + " of " + std::to_string(frames) +
                    finish());
}

class RunFiles {
 public:
  // @throws InputOutputError, as add() and finish() do
  RunFiles(const RunOptions& options, Simulation& simulation, int frames);

  // To be called for frame 0 and after every frame.
  void add(Simulation& simulation, const RunSummary& seen, int frame);
  void finish();
  // Instead of finish(), for a run that ends early: what holds many frames is complete with those that were
  // added. Returns earlyEndText(), or why it could not.
  [[nodiscard]] std::string finishEarly();
  [[nodiscard]] std::vector<Warning> warnings() const;        // of files that show less than there was
  [[nodiscard]] int lastFrame() const { return lastFrame_; }  // that was added; -1 before

 private:
  void writeTrace() const;

  const RunOptions& options_;
  SavedFiles files_;
  SavedPictures pictures_;
  Trace trace_;
  int lastFrame_ = -1;
  bool isWhole_ = true;  // false when a frame was added in part
};

}  // namespace clothsim
