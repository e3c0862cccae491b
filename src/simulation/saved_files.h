// The states and sequences of states that a run saves, frame by frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "export/sequence.h"
#include "simulation/simulation.h"

namespace clothsim {

// What in a name looks like the number of a frame, but is none that numberedName() understands: "%4d",
// "####", "$F4", "%04i"; "" where there is nothing of the kind.
[[nodiscard]] std::string foreignFrameNumber(const std::string& name);

class SavedFiles {
 public:
  // The extension of a name chooses the format; makeSequenceWriter() and saveState() list them. Sequences and
  // names with %04d get frame 0 and every `every`-th frame, numbered from `first` on. Other names get the
  // last of `frames` frames. @throws UsageError for another extension, InputOutputError
  SavedFiles(const std::vector<std::string>& names, int every, int frames, const Simulation& simulation,
             int first = 0);

  // To be called for frame 0 and after every frame, with the state then. @throws InputOutputError, as
  // finish() does
  void add(const Simulation& simulation, const State& state, int frame);
  // Closes the sequences, which are complete from then on, with the frames that were added.
  void finish();
  // SequenceWriter::losses() of all.
  [[nodiscard]] std::vector<std::string> losses() const;

 private:
  int every_, frames_, first_;
  std::vector<std::string> states_;
  std::vector<std::unique_ptr<SequenceWriter>> sequences_;
};

}  // namespace clothsim
