#include <bit>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/compare.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "gl/context.h"

namespace clothsim {

int compareCommand(const CompareOptions& options) {
  const Scene scene = loadScene(options.scene);
  const gl::HeadlessContext context;
  Progress progress("comparing", options.frames);
  const Comparison result = compareBackends(scene, options.frames, [&](int frame) {
    stopIfInterrupted();
    progress.update(frame);
  });
  progress.finish();

  nlohmann::ordered_json json;
  json["scene"] = options.scene.scene;
  json["device"] = result.device;
  json["frames"] = result.frames;
  json["steps"] = result.steps;
  json["floats"] = result.floats;
  json["differing_floats"] = result.differingFloats;
  json["max_abs_difference"] = result.maxAbsDifference;
  json["first_differing_step"] =
      result.firstDifferingStep ? nlohmann::ordered_json(*result.firstDifferingStep) : nullptr;
  json["bitwise_equal"] = result.differingFloats == 0;
  json["finite"] = result.finite;
  json["state_hash"] = {{"cpu", result.cpuHash}, {"gpu", result.gpuHash}};
  json["self_collision"] = scene.solver.selfCollision ? "asked for, not part of this version" : "off";
  if (options.json) {
    std::cout << json.dump(2) << '\n';
  } else if (result.differingFloats == 0) {
    std::printf(
        "%s: CPU and GPU (%s) agree in every bit of %llu floats after each of %d frames (%llu steps)\n",
        options.scene.scene.c_str(), result.device.c_str(), static_cast<unsigned long long>(result.floats),
        result.frames, static_cast<unsigned long long>(result.steps));
  } else {
    std::printf("%s: CPU and GPU (%s) differ in %llu of %llu floats, by at most %g, first in step %llu\n",
                options.scene.scene.c_str(), result.device.c_str(),
                static_cast<unsigned long long>(result.differingFloats),
                static_cast<unsigned long long>(result.floats), result.maxAbsDifference,
                static_cast<unsigned long long>(result.firstDifferingStep.value_or(0)));
  }
  if (!result.finite) std::cerr << "clothsim: the simulation blew up: numbers are no longer finite\n";
  return result.differingFloats == 0 && result.finite ? 0 : 1;
}

}  // namespace clothsim
