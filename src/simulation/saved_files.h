// The states and sequences of states that a run saves under the names that were asked for, as it goes on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "export/sequence.h"
#include "simulation/simulation.h"

namespace clothsim {

class SavedFiles {
 public:
  // By extension: what makeSequenceWriter() and saveState() know. A sequence and a name with %04d take frame
  // 0 and every `every`-th one, another name the last of `frames` alone.
  // @throws UsageError for another extension, InputOutputError
  SavedFiles(const std::vector<std::string>& names, int every, int frames, const Simulation& simulation);

  // Frame 0 and every frame that is done, in turn; `state` is that of its end. @throws InputOutputError, as
  // finish() does
  void add(const Simulation& simulation, const State& state, int frame);
  // Sequences are there from now on.
  void finish();

 private:
  int every_, frames_;
  std::vector<std::string> states_;
  std::vector<std::unique_ptr<SequenceWriter>> sequences_;
};

}  // namespace clothsim
