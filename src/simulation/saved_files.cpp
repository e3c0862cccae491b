#include "simulation/saved_files.h"

#include <regex>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"

namespace clothsim {

std::string foreignFrameNumber(const std::string& name) {
  if (hasFrameNumber(name)) return "";
  static const std::regex foreign(R"(%[-+. 0-9]*[diu]|##+|\$F[0-9]*)");
  std::smatch found;
  return std::regex_search(name, found, foreign) ? found.str() : "";
}

SavedFiles::SavedFiles(const std::vector<std::string>& names, int every, int frames,
                       const Simulation& simulation, int first)
    : every_(every), frames_(frames), first_(first) {
  for (const std::string& name : names) {
    if (isSequence(name))
      sequences_.push_back(makeSequenceWriter(name, simulation.cloth(), simulation.scene(),
                                              {simulation.scene().solver.framesPerSec, every, first}));
    else if (canSaveStateAs(name))
      states_.push_back(name);
    else
      throw UsageError(
          name + ": the extension is none of .csv, .ply, .obj, .glb, .npz, .state, .pc2, .usda, .usdc, .usd");
  }
}

void SavedFiles::add(const Simulation& simulation, const State& state, int frame) {
  const bool isDue = frame % every_ == 0;
  for (const auto& sequence : sequences_)
    if (isDue) sequence->addFrame(state, simulation.cloth(), simulation.scene());
  for (const std::string& name : states_)
    if (hasFrameNumber(name) ? isDue : frame == frames_)
      saveState(state, simulation.cloth(), numberedName(name, first_ + frame), &simulation.scene());
}

std::vector<std::string> SavedFiles::losses() const {
  std::vector<std::string> all;
  for (const auto& sequence : sequences_)
    for (std::string& loss : sequence->losses()) all.push_back(std::move(loss));
  return all;
}

void SavedFiles::finish() {
  for (const auto& sequence : sequences_) sequence->close();
}

}  // namespace clothsim
