#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/blow_up.h"
#include "app/commands.h"
#include "app/contact_report.h"
#include "app/crossings_json.h"
#include "app/simulation.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "solver/cpu/synchronized.h"
#include "solver/measure.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;

void checkSaves(const RunOptions& options) {
  for (const std::string& save : options.saves)
    if (!canSaveStateAs(save))
      throw UsageError("--save " + save + ": the extension is none of .csv, .ply, .obj, .state");
  for (const std::string& save : options.saves) checkWritable(save);
}

void saveFrame(const RunOptions& options, const Simulation& simulation, const State& state, int frame) {
  const bool last = frame == options.frames;
  for (const std::string& save : options.saves) {
    if (hasFrameNumber(save)) {
      if (frame % options.every == 0) saveState(state, simulation.cloth(), numberedName(save, frame));
    } else if (last) {
      saveState(state, simulation.cloth(), save);
    }
  }
}

// A state file may hold anything; what the steps make of it is the watchdog's affair.
void checkStart(const RunOptions& options, const Measures& measures) {
  if (!measures.firstNonFinite) return;
  throw SimulationError("--from " + options.from + ": particle " + std::to_string(*measures.firstNonFinite) +
                        " is not a finite number. Begin with another state.");
}

// Particles that start inside a collider are pushed out in the first step, and fast.
void reportStartOverlaps(std::uint32_t inColliders, std::uint64_t pairs) {
  if (inColliders > 0)
    std::cerr << "clothsim: " << inColliders << (inColliders == 1 ? " particle starts" : " particles start")
              << " inside a collider; the first step pushes them out\n";
  if (pairs > 0)
    std::cerr << "clothsim: " << pairs
              << (pairs == 1 ? " pair of particles starts" : " pairs of particles start")
              << " nearer than self-collision keeps them; the steps part them\n";
}

// What a run is summed up in; names as in DESIGN.md section 5.
nlohmann::ordered_json summary(const RunOptions& options, const Scene& scene, Simulation& simulation,
                               double seconds, const State& last, const Measures& atEnd, double peakStrain,
                               double maxPenetration, std::uint32_t startInColliders,
                               const ContactReport& contacts) {
  const double steps = static_cast<double>(options.frames) * scene.solver.simulationSteps;
  const double particles = simulation.cloth().particleCount();
  nlohmann::ordered_json json;
  json["scene"] = options.scene.scene;
  json["backend"] = simulation.solver().backend();
  json["device"] = simulation.solver().device();
  json["particles"] = simulation.cloth().particleCount();
  json["springs"] = simulation.cloth().springCount();
  json["triangles"] = simulation.cloth().triangleCount();
  json["frames"] = options.frames;
  json["steps"] = static_cast<std::uint64_t>(steps);
  json["dt"] = stepLength(scene.solver);
  json["sim_seconds"] = steps * stepLength(scene.solver);
  json["seconds"] = seconds;
  json["particle_steps_per_second"] = seconds > 0 ? particles * steps / seconds : 0;
  json["state_hash"] = hashText(stateHash(last));
  json["max_strain"] = atEnd.maxStrain;
  json["peak_strain"] = peakStrain;
  json["min_y"] = atEnd.minY;
  json["centroid"] = {atEnd.centroid.x, atEnd.centroid.y, atEnd.centroid.z};
  json["kinetic_energy"] =
      measure(simulation.cloth(), scene, synchronized(simulation.cloth(), scene, last)).kineticEnergy;
  json["max_penetration"] = maxPenetration;
  json["start_overlaps"] = {{"colliders", startInColliders},        // particles,
                            {"self", contacts.overlapsAtStart()}};  // pairs
  json["finite"] = true;
  contacts.write(json, simulation.cloth(), scene, simulation.solver().contactCounts());
  return json;
}

void printForPeople(const nlohmann::ordered_json& json) {
  for (const auto& [key, value] : json.items())
    std::printf("%-26s %s\n", key.c_str(),
                value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
}

}  // namespace

int runCommand(const RunOptions& options) {
  checkSaves(options);
  const Scene scene = loadScene(options.scene);
  std::optional<gl::HeadlessContext> context;
  if (options.backend == "gpu") context.emplace();
  Simulation simulation(scene, options.backend);
  if (!options.from.empty()) simulation.solver().setState(loadState(options.from, simulation.cloth()));
  if (options.jitter > 0) {
    State jittered = simulation.solver().state();
    jitter(jittered, options.jitter, options.seed);
    simulation.solver().setState(jittered);
  }

  State state = simulation.solver().state();
  Measures measures = measure(simulation.cloth(), scene, state);
  checkStart(options, measures);
  const std::uint32_t startInColliders = particlesInColliders(simulation.cloth(), scene, state);
  double seconds = 0, peakStrain = measures.maxStrain, maxPenetration = measures.maxPenetration;
  ContactReport contacts;
  contacts.add(simulation.cloth(), scene, state, measures.maxStrain);
  reportStartOverlaps(startInColliders, contacts.overlapsAtStart());
  std::optional<CrossingCounter> counter;
  if (options.checkCrossings) counter.emplace(simulation.cloth());
  CrossingSummary crossings;
  if (counter) crossings.add(0, counter->count(state));
  saveFrame(options, simulation, state, 0);
  Progress progress("simulating", options.frames);
  for (int frame = 1; frame <= options.frames; ++frame) {
    stopIfInterrupted();
    const Clock::time_point start = Clock::now();
    simulation.stepFrame();
    simulation.finish();
    seconds += std::chrono::duration<double>(Clock::now() - start).count();
    if (const std::optional<Trouble> trouble = simulation.checkFrame())
      stopBlownUp(*trouble, simulation,
                  {options.scene, options.backend, frame, options.frames,
                   options.saves.empty() ? "" : std::filesystem::path(options.saves.front()).parent_path()});
    state = simulation.solver().state();
    measures = measure(simulation.cloth(), scene, state);
    contacts.add(simulation.cloth(), scene, state, measures.maxStrain);
    peakStrain = std::max(peakStrain, measures.maxStrain);
    maxPenetration = std::max(maxPenetration, measures.maxPenetration);
    if (counter) crossings.add(frame, counter->count(state));
    saveFrame(options, simulation, state, frame);
    progress.update(frame);
  }
  progress.finish();

  nlohmann::ordered_json json = summary(options, scene, simulation, seconds, state, measures, peakStrain,
                                        maxPenetration, startInColliders, contacts);
  if (counter) json["crossings"] = toJson(crossings);
  if (options.json)
    std::cout << json.dump(2) << '\n';
  else
    printForPeople(json);
  return 0;
}

}  // namespace clothsim
