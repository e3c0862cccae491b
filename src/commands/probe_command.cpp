// `probe` measures an OpenGL driver; tools/measure_gpu runs its blocks one after the other.
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "commands/probe.h"
#include "core/interrupt.h"
#include "gl/context.h"

namespace clothsim {

void complainNothingMatches(const std::string& only) {
  throw UsageError("--only " + only + ": expected a part of a case's name, found no case with it");
}

int probeCommand(const std::string& block, bool small, const std::string& only) {
  if (!only.empty() && block != "contract" && block != "steps")
    throw UsageError("--only: expected the block contract or steps, found " + block);
  const gl::HeadlessContext context;
  const ProbeLine line = [](const nlohmann::ordered_json& json) {
    std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
    stopIfInterrupted();
  };
  bool isEqual = true;
  if (block == "limits") probeLimits(line);
  if (block == "programs") probePrograms(line);
  if (block == "contract") isEqual = probeContract(small, only, line);
  if (block == "dispatches") probeDispatches(small, line);
  if (block == "roofs") probeRoofs(small, line);
  if (block == "steps") probeSteps(small, only, line);
  if (block == "groups") probeGroups(small, line);
  if (block == "demo") probeDemo(small, line);
  gl::checkErrors("the measurements");
  return isEqual ? 0 : 1;
}

}  // namespace clothsim
