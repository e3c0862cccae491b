#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "commands/blow_up.h"
#include "commands/commands.h"
#include "commands/print_json.h"
#include "commands/run_files.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "measure/crossings_json.h"
#include "measure/measure.h"
#include "session/replay.h"
#include "simulation/gpu/solvers.h"
#include "simulation/run_summary.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;

// Each file is written by one of the options. @throws UsageError
void checkDistinct(const RunOptions& options) {
  std::set<std::filesystem::path> names;
  const auto add = [&](const std::filesystem::path& name, const std::string& option) {
    if (!names.insert(std::filesystem::absolute(name).lexically_normal()).second)
      throw UsageError(option + ": another option writes " + name.string() +
                       ", too; give each a file of its own");
  };
  for (const std::string& save : options.saves) {
    add(save, "--save " + save);
    if (isPointCache(save)) add(restMeshBeside(save), "--save " + save);
  }
  if (!options.trace.empty()) add(options.trace, "--trace " + options.trace);
}

// @throws UsageError where --every or --first-frame is for no output
void checkNumbering(const RunOptions& options) {
  const auto hasFrames = [](const std::string& save) { return isSequence(save) || hasFrameNumber(save); };
  if (options.firstFrame != 0 && std::ranges::none_of(options.saves, numbersFrames))
    throw UsageError(
        "--first-frame " + std::to_string(options.firstFrame) +
        ": nothing that is saved has numbers of frames; give --save a name as cloth_%04d.obj, or "
        ".usda, .usdc, .usd");
  if (options.every != 1 && std::none_of(options.saves.begin(), options.saves.end(), hasFrames))
    throw UsageError(
        "--every " + std::to_string(options.every) +
        ": nothing is saved every so many frames; give --save a name as cloth_%04d.obj, or .pc2, "
        ".usda, .usdc, .usd");
}

// Checks the names before the run. @throws UsageError for unknown extensions, InputOutputError
void checkSaves(const RunOptions& options) {
  for (const std::string& save : options.saves) {
    checkFrameNumber("--save", save);
    if (!isSequence(save) && !isPicture(save) && !canSaveStateAs(save))
      throw UsageError("--save " + save +
                       ": the extension is none of .csv, .ply, .obj, .glb, .npz, .state, .pc2, .usda, .usdc, "
                       ".usd, .png, .mp4, .webp");
  }
  checkNumbering(options);
  for (const std::string& save : options.saves) {
    checkWritable(numberedName(save, options.firstFrame + options.frames.value_or(0)));
    if (isPointCache(save)) checkWritable(restMeshBeside(save));
  }
  checkDistinct(options);
  if (options.trace.empty()) return;
  const std::string extension = std::filesystem::path(options.trace).extension().string();
  if (extension != ".csv" && extension != ".npz")
    throw UsageError("--trace " + options.trace +
                     ": expected a name ending in .csv or .npz, as energies.csv");
  checkWritable(options.trace);
}

// Whether there are pictures to draw, which needs OpenGL.
bool savesPictures(const RunOptions& options) {
  return std::any_of(options.saves.begin(), options.saves.end(), isPicture);
}

// A state file may hold anything. The watchdog checks only what steps compute.
void checkStart(const RunOptions& options, const Measures& measures) {
  if (!measures.firstNonFinite) return;
  throw SimulationError("--from " + options.from + ": particle " + std::to_string(*measures.firstNonFinite) +
                        " is not a finite number. Begin with another state.");
}

// A run of a scene, from its start or from a saved state, or of a recording.
class Run {
 public:
  explicit Run(const RunOptions& options) : isReplay_(!options.replay.empty()) {
    if (isReplay_) {
      Recording recording = Recording::load(options.replay);
      frames_ = options.frames.value_or(recording.frames);
      std::optional<std::string> backend;
      if (options.backend)
        backend = preparedBackend(options);
      else if (usesGpu(recording) || savesPictures(options))
        context_.emplace();
      replay_.emplace(std::move(recording), backend, makeSolver);
    } else {
      const Shared<Scene> scene = loadScene(options.scene);
      frames_ = options.frames.value_or(0);
      const std::string backend = preparedBackend(options);
      plain_.emplace(scene, backend, makeSolver);
      if (!options.from.empty()) continueFrom(options.from, *plain_);
      if (options.jitter > 0) {
        State jittered = plain_->state();
        jitter(jittered, options.jitter, options.seed);
        plain_->setState(jittered);
      }
    }
  }

  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] int soundFrames() const { return soundFrames_; }
  [[nodiscard]] bool isReplay() const { return isReplay_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] double simulatedSeconds() const { return simulatedSeconds_; }
  [[nodiscard]] std::vector<Warning> warnings() const {
    std::vector<Warning> warnings;
    if (isReplay_)
      for (const std::string& remark : replay_->remarks())
        warnings.push_back({"file", std::nullopt, remark, remark});
    return warnings;
  }
  [[nodiscard]] Simulation& simulation() { return isReplay_ ? replay_->session().simulation() : *plain_; }
  [[nodiscard]] const Scene& scene() { return simulation().scene(); }

  void stepFrame() {
    stepsOfFrame_ = static_cast<std::uint64_t>(scene().solver.simulationSteps);
    secondsOfFrame_ = 1 / scene().solver.framesPerSec;
    if (isReplay_)
      replayDivergence_ = replay_->stepFrame();
    else
      plain_->stepFrame();
    simulation().finish();
  }
  // Returns the divergence in the last frame, if any; else the frame counts.
  [[nodiscard]] std::optional<Divergence> checkFrame() {
    const std::optional<Divergence> divergence = isReplay_ ? replayDivergence_ : plain_->checkFrame();
    if (divergence) return divergence;
    ++soundFrames_;
    steps_ += stepsOfFrame_;
    simulatedSeconds_ += secondsOfFrame_;
    return std::nullopt;
  }

 private:
  // Makes the context that the backend or the pictures need. "auto" goes without one where there is none, and
  // says so.
  std::string preparedBackend(const RunOptions& options) {
    const std::string wish = options.backend.value_or("auto");
    const bool needsPictures = savesPictures(options);
    if (wish == "cpu" && !needsPictures) return wish;
    try {
      context_.emplace();
    } catch (const OpenGlError&) {
      if (wish != "auto" || needsPictures) throw;
      std::fputs(
          "clothsim: simulating on the CPU, since there is no usable OpenGL; clothsim doctor says more\n",
          stderr);
      return "cpu";
    }
    return announcedBackend(wish);
  }

  static bool usesGpu(const Recording& recording) {
    return recording.backend == "gpu" ||
           std::any_of(recording.events.begin(), recording.events.end(), [](const Recording::Event& event) {
             const auto* to = std::get_if<SwitchBackend>(&event.action);
             return to != nullptr && to->backend == "gpu";
           });
  }

  bool isReplay_;
  int frames_ = 0, soundFrames_ = 0;
  std::uint64_t steps_ = 0, stepsOfFrame_ = 0;
  double simulatedSeconds_ = 0, secondsOfFrame_ = 0;
  std::optional<gl::HeadlessContext> context_;
  std::optional<Simulation> plain_;
  std::optional<Replay> replay_;
  std::optional<Divergence> replayDivergence_;
};

// What `run --json` prints.
nlohmann::ordered_json summary(const RunOptions& options, Run& run, const RunSummary& seen) {
  Simulation& simulation = run.simulation();
  const Scene& scene = run.scene();
  const State& last = seen.state;
  const auto steps = static_cast<double>(run.steps());
  const double particles = simulation.cloth().particleCount();
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (run.isReplay())
    json["replay"] = options.replay;
  else
    json["scene"] = options.scene.scene;
  json["backend"] = simulation.solver().backend();
  json["device"] = simulation.solver().device();
  json["particles"] = simulation.cloth().particleCount();
  json["springs"] = remainingSpringCount(simulation.cloth(), last.cuts);
  json["triangles"] = remainingTriangleCount(simulation.cloth(), last.cuts);
  json["frames"] = run.soundFrames();
  json["steps"] = run.steps();
  json["dt"] = stepLength(scene.solver);
  json["integrator"] = integratorName(scene.solver.integrator);
  json["simulation_steps"] = scene.solver.simulationSteps.count;
  if (isImplicit(scene.solver.integrator)) json["cg_iterations"] = scene.solver.cgIterations.count;
  json["sim_seconds"] = run.isReplay() ? run.simulatedSeconds() : steps * stepLength(scene.solver);
  json["seconds"] = seen.seconds;
  json["particle_steps_per_second"] = seen.seconds > 0 ? particles * steps / seen.seconds : 0;
  seen.write(json, simulation);
  return json;
}

// What it prints of a run that ended early: the last sound frame, and why it is the last.
nlohmann::ordered_json summaryOfBlowUp(const RunOptions& options, Run& run, const RunSummary& seen,
                                       const Divergence& divergence) {
  nlohmann::ordered_json json = summary(options, run, seen);
  json["finite"] = false;
  json["divergence"] = {
      {"frame", run.soundFrames() + 1},
      {"step", divergence.step},
      {"particle", divergence.particle},
      {"text", divergenceText(divergence, run.simulation().cloth(), run.scene(), run.soundFrames() + 1)}};
  return json;
}

nlohmann::ordered_json summaryOfInterrupted(const RunOptions& options, Run& run, const RunSummary& seen) {
  nlohmann::ordered_json json = summary(options, run, seen);
  json["interrupted"] = true;
  return json;
}

BlowUpContext contextOf(const RunOptions& options, Run& run, int frame, const std::string& filesText) {
  SceneOptions scene = options.scene;
  if (run.isReplay()) scene.scene = options.replay;
  return {scene,
          run.simulation().solver().backend(),
          frame,
          run.frames(),
          options.saves.empty() ? "" : std::filesystem::path(options.saves.front()).parent_path(),
          filesText,
          run.isReplay() ? nullptr : &options,
          run.isReplay()};
}

void printForPeople(const nlohmann::ordered_json& json) {
  for (const auto& [key, value] : json.items())
    if (key != "warnings")  // these are printed on stderr
      std::printf("%-26s %s\n", key.c_str(),
                  value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
}

}  // namespace

int runCommand(const RunOptions& options) {
  checkSaves(options);
  Run run(options);
  const int frames = run.frames();
  RunSummary seen;
  seen.watchesEnergy = !run.isReplay() && options.from.empty();
  seen.add(run.simulation());
  checkStart(options, seen.measures);
  const std::vector<Warning> atStart = seen.watch.warnings(run.scene());
  print(atStart);
  std::optional<CrossingCounter> counter;
  Shared<Cloth> countedCloth = run.simulation().sharedCloth();
  if (options.checkCrossings) counter.emplace(countedCloth);
  CrossingSummary crossings;
  if (counter) crossings.add(0, counter->count(seen.state));
  RunFiles files(options, run.simulation(), frames);
  files.add(run.simulation(), seen, 0);
  Progress progress("simulating", frames);
  const auto simulateFrame = [&](int frame) {
    stopIfInterrupted();
    const Clock::time_point start = Clock::now();
    run.stepFrame();
    seen.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    if (const std::optional<Divergence> divergence = run.checkFrame()) {
      if (options.json) printJson(summaryOfBlowUp(options, run, seen, *divergence));
      stopBlownUp(*divergence, run.simulation(), contextOf(options, run, frame, files.finishEarly()));
    }
    seen.add(run.simulation());
    if (counter && !countedCloth.isSameAs(run.simulation().sharedCloth())) {
      countedCloth = run.simulation().sharedCloth();
      counter.emplace(countedCloth);
    }
    if (counter) crossings.add(frame, counter->count(seen.state));
    files.add(run.simulation(), seen, frame);
    progress.update(frame);
  };
  try {
    for (int frame = 1; frame <= frames; ++frame) simulateFrame(frame);
  } catch (const Interrupted&) {
    if (options.json) printJson(summaryOfInterrupted(options, run, seen));
    stopInterrupted(files.lastFrame(), frames, [&] { return files.finishEarly(); });
  }
  files.finish();
  progress.finish();

  std::vector<Warning> warnings = seen.watch.warnings(run.scene());
  std::ranges::move(files.warnings(), std::back_inserter(warnings));
  std::ranges::move(run.warnings(), std::back_inserter(warnings));
  nlohmann::ordered_json json = summary(options, run, seen);
  json["warnings"] = toJson(warnings);
  if (counter) json["crossings"] = toJson(crossings);
  if (options.json)
    printJson(json);
  else
    printForPeople(json);
  printLater(warnings, atStart);
  checkStrict(options.strict, warnings);
  return 0;
}

}  // namespace clothsim
