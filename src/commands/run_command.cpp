#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands/blow_up.h"
#include "commands/commands.h"
#include "commands/print_json.h"
#include "commands/saves.h"
#include "commands/tally.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "measure/crossings_json.h"
#include "measure/measure.h"
#include "session/replay.h"
#include "simulation/simulation.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;

// A state file may hold anything; what the steps make of it is the watchdog's affair.
void checkStart(const RunOptions& options, const Measures& measures) {
  if (!measures.firstNonFinite) return;
  throw SimulationError("--from " + options.from + ": particle " + std::to_string(*measures.firstNonFinite) +
                        " is not a finite number. Begin with another state.");
}

// What is run: a scene from its start or a saved state, or a recording.
class Course {
 public:
  explicit Course(const RunOptions& options) : isReplay_(!options.replay.empty()) {
    if (isReplay_) {
      Recording recording = Recording::load(options.replay);
      frames_ = options.frames.value_or(recording.frames);
      if (usesGpu(recording, options) || savesPictures(options)) context_.emplace();
      replay_.emplace(std::move(recording), options.backend);
    } else {
      const Scene scene = loadScene(options.scene);
      const std::string backend = options.backend.value_or("gpu");
      frames_ = options.frames.value_or(0);
      if (backend == "gpu" || savesPictures(options)) context_.emplace();
      plain_.emplace(scene, backend);
      if (!options.from.empty()) plain_->solver().setState(loadState(options.from, plain_->cloth()));
      if (options.jitter > 0) {
        State jittered = plain_->solver().state();
        jitter(jittered, options.jitter, options.seed);
        plain_->solver().setState(jittered);
      }
    }
  }

  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] bool isReplay() const { return isReplay_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] double simulatedSeconds() const { return simulatedSeconds_; }
  // Another one after an edit that rebuilds the cloth.
  [[nodiscard]] std::uint64_t clothGeneration() {
    return isReplay_ ? replay_->session().clothGeneration() : 0;
  }
  [[nodiscard]] Simulation& simulation() { return isReplay_ ? replay_->session().simulation() : *plain_; }
  [[nodiscard]] const Scene& scene() { return simulation().scene(); }

  void stepFrame() {
    const SolverSettings& settings = scene().solver;
    steps_ += static_cast<std::uint64_t>(settings.simulationSteps);
    simulatedSeconds_ += 1 / settings.framesPerSec;
    if (isReplay_)
      replayTrouble_ = replay_->stepFrame();
    else
      plain_->stepFrame();
    simulation().finish();
  }
  // In the frame just done.
  [[nodiscard]] std::optional<Trouble> checkFrame() {
    return isReplay_ ? replayTrouble_ : plain_->checkFrame();
  }

 private:
  static bool usesGpu(const Recording& recording, const RunOptions& options) {
    if (options.backend) return *options.backend == "gpu";
    return recording.backend == "gpu" ||
           std::any_of(recording.events.begin(), recording.events.end(), [](const Recording::Event& event) {
             const auto* to = std::get_if<SwitchBackend>(&event.action);
             return to != nullptr && to->backend == "gpu";
           });
  }

  bool isReplay_;
  int frames_ = 0;
  std::uint64_t steps_ = 0;
  double simulatedSeconds_ = 0;
  std::optional<gl::HeadlessContext> context_;
  std::optional<Simulation> plain_;
  std::optional<Replay> replay_;
  std::optional<Trouble> replayTrouble_;
};

// What `run --json` prints.
nlohmann::ordered_json summary(const RunOptions& options, Course& course, const Tally& tally) {
  Simulation& simulation = course.simulation();
  const Scene& scene = course.scene();
  const State& last = tally.state;
  const auto steps = static_cast<double>(course.steps());
  const double particles = simulation.cloth().particleCount();
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (course.isReplay())
    json["replay"] = options.replay;
  else
    json["scene"] = options.scene.scene;
  json["backend"] = simulation.solver().backend();
  json["device"] = simulation.solver().device();
  json["particles"] = simulation.cloth().particleCount();
  json["springs"] = remainingSpringCount(simulation.cloth(), last.cuts);
  json["triangles"] = remainingTriangleCount(simulation.cloth(), last.cuts);
  json["frames"] = course.frames();
  json["steps"] = course.steps();
  json["dt"] = stepLength(scene.solver);
  json["integrator"] = integratorName(scene.solver.integrator);
  json["simulation_steps"] = scene.solver.simulationSteps.count;
  if (scene.solver.integrator == Integrator::implicit)
    json["cg_iterations"] = scene.solver.cgIterations.count;
  json["sim_seconds"] = course.isReplay() ? course.simulatedSeconds() : steps * stepLength(scene.solver);
  json["seconds"] = tally.seconds;
  json["particle_steps_per_second"] = tally.seconds > 0 ? particles * steps / tally.seconds : 0;
  tally.write(json, simulation);
  return json;
}

void printForPeople(const nlohmann::ordered_json& json) {
  for (const auto& [key, value] : json.items())
    if (key != "warnings")  // they follow, a line each
      std::printf("%-26s %s\n", key.c_str(),
                  value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
}

}  // namespace

int runCommand(const RunOptions& options) {
  checkSaves(options);
  Course course(options);
  const int frames = course.frames();
  Tally tally;
  tally.add(course.simulation());
  checkStart(options, tally.measures);
  std::optional<CrossingCounter> counter;
  std::uint64_t countedCloth = course.clothGeneration();
  if (options.checkCrossings) counter.emplace(course.simulation().cloth());
  CrossingSummary crossings;
  if (counter) crossings.add(0, counter->count(tally.state));
  Saves saves(options, course.simulation(), frames);
  saves.add(course.simulation(), course.clothGeneration(), tally.state, 0);
  Progress progress("simulating", frames);
  for (int frame = 1; frame <= frames; ++frame) {
    stopIfInterrupted();
    const Clock::time_point start = Clock::now();
    course.stepFrame();
    tally.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    if (const std::optional<Trouble> trouble = course.checkFrame()) {
      SceneOptions scene = options.scene;
      if (course.isReplay()) scene.scene = options.replay;
      stopBlownUp(*trouble, course.simulation(),
                  {scene, course.simulation().solver().backend(), frame, frames,
                   options.saves.empty() ? "" : std::filesystem::path(options.saves.front()).parent_path(),
                   course.isReplay()});
    }
    tally.add(course.simulation());
    if (counter && std::exchange(countedCloth, course.clothGeneration()) != course.clothGeneration())
      counter.emplace(course.simulation().cloth());
    if (counter) crossings.add(frame, counter->count(tally.state));
    saves.add(course.simulation(), course.clothGeneration(), tally.state, frame);
    progress.update(frame);
  }
  saves.finish();
  progress.finish();

  nlohmann::ordered_json json = summary(options, course, tally);
  if (counter) json["crossings"] = toJson(crossings);
  if (options.json)
    printJson(json);
  else
    printForPeople(json);
  const std::vector<Warning> warnings = tally.watch.warnings(course.scene());
  print(warnings);
  checkStrict(options.strict, warnings);
  return 0;
}

}  // namespace clothsim
