#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/bench.h"
#include "commands/commands.h"
#include "commands/print_json.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "gl/context.h"
#include "scene_io/scene_io.h"
#include "simulation/simulation.h"

namespace clothsim {
namespace {

nlohmann::ordered_json toJson(const StepRate& rate) {
  nlohmann::ordered_json json{{"backend", rate.backend},
                              {"device", rate.device},
                              {"resolution", rate.points},
                              {"cloths", rate.cloths},
                              {"strain_limit", rate.limiter},
                              {"self_collision", selfCollisionName(rate.selfCollision)},
                              {"repetitions", rate.repetitions},
                              {"ms_per_step", rate.secondsPerStep * 1e3},
                              {"particle_steps_per_second", rate.particleStepsPerSecond}};
  if (rate.dispatchesPerStep > 0) {
    json["dispatches_per_step"] = rate.dispatchesPerStep;
    json["submit_ms_per_step"] = rate.submitSecondsPerStep * 1e3;
  }
  if (rate.operationsPerSecond > 0) {
    json["bytes_per_particle"] = rate.bytesPerParticle;
    json["roof"] = {{"copied_bytes_per_second", rate.copiedBytesPerSecond},
                    {"operations_per_second", rate.operationsPerSecond}};
  }
  if (rate.operationsPerParticle > 0)
    json["share_of_roof"] = {{"memory", rate.memoryShare()}, {"arithmetic", rate.arithmeticShare()}};
  for (const PassTime& pass : rate.passes) json["pass_ms"][pass.name] = pass.seconds * 1e3;
  return json;
}

void print(const StepRate& rate) {
  const bool contacts = rate.selfCollision != SelfCollision::off;
  std::printf("%-4s %-11s %-7s %-8s %10.4f ms/step %9.1f M particle-steps/s", rate.backend.c_str(),
              rate.points.c_str(), rate.limiter ? "limiter" : "",
              contacts ? selfCollisionName(rate.selfCollision) : "", rate.secondsPerStep * 1e3,
              rate.particleStepsPerSecond * 1e-6);
  if (rate.operationsPerParticle > 0)
    std::printf("   %3.0f %% of %.0f GB/s copied, %3.0f %% of %.0f G operations/s", 100 * rate.memoryShare(),
                rate.copiedBytesPerSecond * 1e-9, 100 * rate.arithmeticShare(),
                rate.operationsPerSecond * 1e-9);
  if (rate.bytesPerParticle > 0) std::printf("   %.0f B/particle", rate.bytesPerParticle);
  if (rate.dispatchesPerStep > 0)
    std::printf("   %llu dispatches/step", static_cast<unsigned long long>(rate.dispatchesPerStep));
  if (rate.cloths > 1) std::printf("   %zu cloths", rate.cloths);
  for (const PassTime& pass : rate.passes)
    std::printf("   %s %.4f ms", pass.name.c_str(), pass.seconds * 1e3);
  std::printf("\n");
  std::fflush(stdout);
}

std::string drawnText(int width, int height) {
  return width > 0 ? "drawn at " + std::to_string(width) + "x" + std::to_string(height) : "not drawn";
}

void print(const DemoRate& rate, const std::string& backend, const std::string& drawn) {
  std::printf("demo in real time at 30 frames/s, %s, %s: ", backend.c_str(), drawn.c_str());
  if (rate.size == 0)
    std::printf("none (16x16 is too slow)\n");
  else
    std::printf("%dx%d (a 30th of a second takes %.1f ms to simulate, %.1f ms to draw)\n", rate.size,
                rate.size, rate.simulationSeconds * 1e3, rate.drawSeconds * 1e3);
  std::fflush(stdout);
}

// The largest demo in real time at 30 frames/s on each backend: not drawn, and drawn in a small and in the
// default window.
nlohmann::ordered_json benchDemo(const std::vector<std::string>& backends, bool printed) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const std::string& backend : backends) {
    for (const auto& [width, height] : {std::pair{0, 0}, std::pair{640, 360}, std::pair{1280, 720}}) {
      const DemoRate rate = largestRealTimeDemo(backend, width, height);
      const std::string drawn = drawnText(width, height);
      json.push_back({{"backend", backend},
                      {"drawn", drawn},
                      {"size", rate.size},
                      {"simulation_ms", rate.simulationSeconds * 1e3},
                      {"draw_ms", rate.drawSeconds * 1e3}});
      if (printed) print(rate, backend, drawn);
    }
  }
  return json;
}

// The resolutions that were asked for, else `usual`. A scene of meshes alone has none.
std::vector<std::optional<GridSize>> resolutionsOf(const BenchOptions& options,
                                                   const std::vector<GridSize>& usual) {
  if (!options.resolutions.empty()) return {options.resolutions.begin(), options.resolutions.end()};
  const std::vector<ClothSettings> cloths = loadSceneByName(options.scene.scene).cloths;
  const bool hasGrid =
      std::any_of(cloths.begin(), cloths.end(), [](const ClothSettings& cloth) { return !cloth.isMesh(); });
  if (!hasGrid) return {std::nullopt};
  return {usual.begin(), usual.end()};
}

State stateAfter(const Scene& scene, int frames) {
  Simulation simulation(scene, "cpu");
  Progress progress("simulating", frames);
  for (int frame = 1; frame <= frames; ++frame) {
    stopIfInterrupted();
    simulation.stepFrame();
    progress.update(frame);
  }
  progress.finish();
  return simulation.state();
}

// The scene with springs alone, with the strain limit, and with the limit and either self-collision; implicit
// steps without contact between layers, and with it.
std::vector<Scene> variantsOf(const Scene& scene) {
  if (isImplicit(scene.solver.integrator)) {
    std::vector<Scene> both(2, scene);
    both[0].solver.selfCollision = SelfCollision::off;
    both[1].solver.selfCollision = SelfCollision::contact;
    return both;
  }
  std::vector<Scene> variants(4, scene);
  for (Scene& variant : variants) {
    variant.solver.strainLimit = scene.solver.strainLimit.value_or(0.1);
    variant.solver.selfCollision = SelfCollision::off;
  }
  variants[0].solver.strainLimit.reset();
  variants[2].solver.selfCollision = SelfCollision::averaged;
  variants[3].solver.selfCollision = SelfCollision::robust;
  return variants;
}

// Times every shading model on the cloth after some frames, in every quality.
int benchDrawing(const BenchOptions& options) {
  constexpr int width = 1280, height = 720;
  const gl::HeadlessContext context;
  SceneOptions sceneOptions = options.scene;
  sceneOptions.resolution = resolutionsOf(options, {{64, 64}}).front();
  Scene scene = loadScene(sceneOptions);
  const State state = stateAfter(scene, options.afterFrames);
  nlohmann::ordered_json json{{"scene", options.scene.scene}, {"device", context.info().renderer}};
  for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
    for (const std::string_view shader : shadingModels) {
      stopIfInterrupted();
      scene.render.shader = shader;
      const DrawRate rate = measureDrawing(scene, state, quality, width, height);
      nlohmann::ordered_json entry{{"shader", rate.shader},
                                   {"quality", nameOf(quality)},
                                   {"scale", rate.scale},
                                   {"ms", rate.seconds * 1e3},
                                   {"processor_ms", rate.processorSeconds * 1e3}};
      std::string passes;
      for (const DrawTime& pass : rate.passes) {
        entry["pass_ms"][pass.pass] = pass.seconds * 1e3;
        char text[64];
        std::snprintf(text, sizeof text, "   %s %.2f", pass.pass.c_str(), pass.seconds * 1e3);
        passes += text;
      }
      json["drawing"].push_back(entry);
      if (!options.json)
        std::printf("%-13s %-7s at %3.0f %% %7.2f ms (of processors %.2f)%s\n", rate.shader.c_str(),
                    nameOf(quality).data(), 100 * rate.scale, rate.seconds * 1e3, rate.processorSeconds * 1e3,
                    passes.c_str());
      std::fflush(stdout);
    }
  }
  if (options.json) printJson(json);
  return 0;
}

}  // namespace

int benchCommand(const BenchOptions& options) {
  if (options.draw) return benchDrawing(options);
  std::vector<std::string> backends = options.backends;
  if (backends.empty()) backends = {"cpu", "gpu"};
  const bool needsGpu = std::find(backends.begin(), backends.end(), "gpu") != backends.end();
  std::optional<gl::HeadlessContext> context;
  if (needsGpu) context.emplace();

  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["scene"] = options.scene.scene;
  for (const auto& resolution : resolutionsOf(options, {{64, 64}, {128, 128}, {256, 256}})) {
    SceneOptions sceneOptions = options.scene;
    sceneOptions.resolution = resolution;
    const Scene scene = loadScene(sceneOptions);
    const State state = stateAfter(scene, options.afterFrames);
    for (const Scene& variant : variantsOf(scene)) {
      for (const std::string& backend : backends) {
        const StepRate rate = measureStepRate(variant, backend, options.seconds, state);
        json["steps"].push_back(toJson(rate));
        if (!options.json) print(rate);
      }
    }
  }
  if (needsGpu) json["demo_real_time"] = benchDemo(backends, !options.json);  // drawing needs the context
  if (options.json) printJson(json);
  return 0;
}

}  // namespace clothsim
