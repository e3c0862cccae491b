#include <iostream>
#include <regex>

#include "commands/commands.h"
#include "commands/proposal.h"
#include "core/error.h"
#include "export/export.h"

namespace clothsim {

GridSize parseSize(const std::string& text, const std::string& flag) {
  std::smatch match;
  if (!std::regex_match(text, match, std::regex("([0-9]{1,9})[xX]([0-9]{1,9})")))
    throw UsageError(flag + " " + text + ": expected WIDTHxHEIGHT, as 512x512");
  return {std::stoi(match[1]), std::stoi(match[2])};
}

GridSize parseResolution(const std::string& text) {
  if (text != "auto") return parseSize(text, "--resolution");
  const int size = proposalHere().size;
  return {size, size};
}

void continueFrom(const std::string& file, Simulation& simulation) {
  const State state = loadState(file, simulation.cloth());
  if (const std::string remark = remarkOfState(state, simulation.cloth()); !remark.empty())
    std::cerr << "clothsim: " << file << ": " << remark << '\n';
  simulation.setState(state);
}

Scene loadScene(const SceneOptions& options) {
  RemarkedScene read = readScene(options);
  for (const std::string& remark : read.remarks) std::cerr << "clothsim: " << remark << '\n';
  return std::move(read.scene);
}

}  // namespace clothsim
