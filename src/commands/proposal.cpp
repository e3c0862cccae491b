#include "commands/proposal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands/bench.h"
#include "commands/version.h"
#include "core/error.h"
#include "core/files.h"
#include "core/thread_team.h"
#include "core/vector_set.h"
#include "gl/context.h"
#include "scene_io/scene_io.h"
#include "solver/state.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr int SIZES[] = {48, 64, 80, 96, 128, 192, 256, 384, 512, 768, 1024};
constexpr int WIDTH = 1280, HEIGHT = 720;
constexpr double SIMULATED = 1.0 / 30;      // that the seconds of a simulation are for [s]
constexpr double QUICK_PICTURE = 1.0 / 60;  // a better quality may take so much [s]
constexpr int PICTURES = 5;
constexpr double HOPELESS = 2;  // so many times the limit are not measured again

Scene demoOf(int size) {
  Scene scene = loadSceneByName("demo");
  (void)changeResolution(scene, size, size, false);
  return scene;
}

// The best quality of which a picture is quick; draft, if none is.
void chooseQuality(Proposal& proposal) {
  const Scene scene = demoOf(proposal.size);
  const State state = initialState(Cloth(scene), scene);
  for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
    const double seconds = measureDrawing(scene, state, quality, WIDTH, HEIGHT, PICTURES).leastSeconds;
    if (quality != Quality::draft && seconds > QUICK_PICTURE) return;
    proposal.quality = quality;
    proposal.drawSeconds = seconds;
    if (seconds > QUICK_PICTURE / 2) return;
  }
}

// How long simulating a 30th of a second may take beside the pictures. A GPU has a quarter of its time left
// then. On a software renderer the same cores draw, 30 pictures a second; folds make the demo's steps seven
// tenths dearer later, and that both want the cores at once makes all of it a third dearer.
double limitOf(const Proposal& proposal, bool software) {
  constexpr double folds = 1.7, shared = 4.0 / 3, pictures = 30;
  return software ? SIMULATED * (1 - pictures * proposal.drawSeconds) / (folds * shared)
                  : 0.75 * SIMULATED - proposal.drawSeconds;
}

// The largest size that stays within the limit; the smallest, if none does.
void chooseSize(Proposal& proposal, bool software) {
  const double limit = limitOf(proposal, software);
  for (const int size : SIZES) {
    double seconds = INFINITY;  // the least of some: others may use the cores, too
    for (int k = 0; k < 4; ++k) {
      seconds = std::min(seconds, measureDemo(size, proposal.backend, 0, 0).simulationSeconds);
      if (seconds <= limit || seconds > HOPELESS * limit) break;
    }
    if (seconds > limit && size != SIZES[0]) return;
    proposal.size = size;
    proposal.simulationSeconds = seconds;
    if (seconds > limit) return;
  }
}

}  // namespace

Proposal measureProposal(bool both) {
  const bool software = gl::currentContextInfo().software;
  Proposal proposal{.backend = software ? "cpu" : "gpu", .size = SIZES[0]};
  chooseQuality(proposal);
  chooseSize(proposal, software);
  if (software && !both) return proposal;
  Proposal other = proposal;
  other.backend = software ? "gpu" : "cpu";
  chooseSize(other, software);
  return other.size > proposal.size ? other : proposal;
}

std::string machineName() {
  const gl::ContextInfo& info = gl::currentContextInfo();
  return std::string(versionText()) + "; " + info.renderer + "; " + info.version + "; " +
         std::to_string(ThreadTeam::shared().threads()) + " threads of " + std::string(nameOf(vectorSet()));
}

fs::path proposalPath() {
  const fs::path folder = userConfigFolder();
  return folder.empty() ? folder : folder / "machine.json";
}

std::optional<Proposal> keptProposal(const fs::path& path, const std::string& machine) {
  constexpr std::uintmax_t largestFile = 64 * 1024;
  if (path.empty()) return std::nullopt;
  try {
    const nlohmann::json kept = nlohmann::json::parse(readFile(path, largestFile));
    const std::optional<Quality> quality = qualityNamed(kept.at("quality").get<std::string>());
    Proposal proposal{kept.at("backend").get<std::string>(), kept.at("size").get<int>(),
                      quality.value_or(Quality::draft), kept.at("simulation_seconds").get<double>(),
                      kept.at("draw_seconds").get<double>()};
    const bool isOne = kept.at("machine") == machine && quality &&
                       (proposal.backend == "cpu" || proposal.backend == "gpu") &&
                       std::find(std::begin(SIZES), std::end(SIZES), proposal.size) != std::end(SIZES);
    return isOne ? std::optional(proposal) : std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string keepProposal(const Proposal& proposal, const fs::path& path, const std::string& machine) {
  nlohmann::ordered_json json;
  json["machine"] = machine;
  json["backend"] = proposal.backend;
  json["size"] = proposal.size;
  json["quality"] = std::string(nameOf(proposal.quality));
  json["simulation_seconds"] = proposal.simulationSeconds;
  json["draw_seconds"] = proposal.drawSeconds;
  return saveInConfigFolder(path, json.dump(2) + "\n");
}

std::string resolutionOf(const Proposal& proposal) {
  return std::to_string(proposal.size) + "x" + std::to_string(proposal.size);
}

Proposal proposalHere() {
  const gl::HeadlessContext context;
  const std::string machine = machineName();
  if (const std::optional<Proposal> kept = keptProposal(proposalPath(), machine)) return *kept;
  std::fprintf(stderr, "clothsim: measuring what suits this machine ...\n");
  const Proposal proposal = measureProposal(false);
  std::fprintf(stderr, "clothsim: %s points on the %s backend, pictures in %s quality\n",
               resolutionOf(proposal).c_str(), proposal.backend.c_str(),
               std::string(nameOf(proposal.quality)).c_str());
  if (const std::string fault = keepProposal(proposal, proposalPath(), machine); !fault.empty())
    std::fprintf(stderr, "clothsim: it will be measured again next time: %s\n", fault.c_str());
  return proposal;
}

}  // namespace clothsim
