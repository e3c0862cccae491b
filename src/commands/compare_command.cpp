#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands/blow_up.h"
#include "commands/commands.h"
#include "commands/print_json.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "gl/context.h"
#include "measure/contact_report.h"
#include "measure/crossings_json.h"
#include "measure/measure.h"
#include "simulation/compare.h"
#include "simulation/gpu/solvers.h"

namespace clothsim {
namespace {

nlohmann::ordered_json textOf(const std::optional<Divergence>& divergence, const Cloth& cloth,
                              const Scene& scene) {
  return divergence ? nlohmann::ordered_json(divergenceText(*divergence, cloth, scene)) : nullptr;
}

// What was looked at beside the bits.
struct Looks {
  std::optional<CrossingCounter> counter;  // where crossings are asked for
  CrossingSummary crossings;
  ContactReport contacts;
  double maxPenetration = 0;  // [m]
};

nlohmann::ordered_json jsonOf(const CompareOptions& options, const Comparison& result, const Looks& looks,
                              const Cloth& cloth, const Scene& scene) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["scene"] = options.scene.scene;
  json["device"] = result.device;
  json["frames"] = result.frames;
  json["steps"] = result.steps;
  json["integrator"] = integratorName(scene.solver.integrator);
  json["floats"] = result.floats;
  json["differing_floats"] = result.differingFloats;
  json["max_abs_difference"] = result.maxAbsDifference;
  json["first_differing_step"] =
      result.firstDifferingStep ? nlohmann::ordered_json(*result.firstDifferingStep) : nullptr;
  json["bitwise_equal"] = result.differingFloats == 0;
  json["finite"] = result.finite;
  json["same_divergence"] = result.cpuDivergence == result.gpuDivergence;  // on both backends, or on none
  if (result.cpuDivergence || result.gpuDivergence)
    json["divergence"] = {{"frame", result.frames + 1},
                          {"cpu", textOf(result.cpuDivergence, cloth, scene)},
                          {"gpu", textOf(result.gpuDivergence, cloth, scene)}};
  json["state_hash"] = {{"cpu", result.cpuHash}, {"gpu", result.gpuHash}};
  json["max_penetration"] = looks.maxPenetration;
  looks.contacts.write(json, cloth, scene, result.contacts);
  if (looks.counter) json["crossings"] = toJson(looks.crossings);
  return json;
}

void printComparison(const std::string& name, const Comparison& result, const Looks& looks) {
  const auto number = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
  if (result.differingFloats == 0)
    std::printf(
        "%s: CPU and GPU (%s) agree in every bit of %llu floats after each of %d frames (%llu steps)\n",
        name.c_str(), result.device.c_str(), number(result.floats), result.frames, number(result.steps));
  else
    std::printf("%s: CPU and GPU (%s) differ in %llu of %llu floats, by at most %g, first in step %llu\n",
                name.c_str(), result.device.c_str(), number(result.differingFloats), number(result.floats),
                result.maxAbsDifference, number(result.firstDifferingStep.value_or(0)));
  if (looks.counter)
    std::printf("crossing pairs of triangles: at most %llu apart and %llu neighbours, in %d frames\n",
                number(looks.crossings.worst), number(looks.crossings.neighbours),
                looks.crossings.framesChecked);
}

// @throws SimulationError where the cloth blew up on some backend
void checkSound(const Comparison& result, const Cloth& cloth, const Scene& scene) {
  const auto blowUp = [&](const std::optional<Divergence>& divergence, const char* backend) {
    if (divergence)
      throw SimulationError(std::string(backend) + blowUpText(*divergence, cloth, scene) +
                            "\n`clothsim run` saves the last good state.");
  };
  if (result.cpuDivergence != result.gpuDivergence) {
    blowUp(result.cpuDivergence, "differently on the two backends; on the CPU ");
    blowUp(result.gpuDivergence, "on the GPU alone ");
  }
  blowUp(result.cpuDivergence, "");
}

}  // namespace

int compareCommand(const CompareOptions& options) {
  const Shared<Scene> sharedScene = loadScene(options.scene);
  const Scene& scene = *sharedScene;
  const gl::HeadlessContext context;
  Progress progress("comparing", options.frames);
  const Shared<Cloth> sharedCloth = Cloth(scene);
  const Cloth& cloth = *sharedCloth;
  Looks looks;
  if (options.checkCrossings) looks.counter.emplace(sharedCloth);
  const Comparison result =
      compareBackends(sharedScene, options.frames, makeSolver, [&](int frame, const State& state) {
        stopIfInterrupted();
        if (looks.counter) looks.crossings.add(frame, looks.counter->count(state));
        const Measures measures = measure(cloth, scene, state);
        looks.maxPenetration = std::max(looks.maxPenetration, measures.maxPenetration);
        looks.contacts.add(frame, cloth, scene, state, measures.maxStrain, {});
        progress.update(frame);
      });
  progress.finish();
  if (options.json)
    printJson(jsonOf(options, result, looks, cloth, scene));
  else
    printComparison(options.scene.scene, result, looks);
  checkSound(result, cloth, scene);
  return result.differingFloats == 0 && result.finite ? 0 : 1;
}

}  // namespace clothsim
