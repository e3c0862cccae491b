// Measurements of a driver: its limits, its compiler, and how fast it does steps.
#include <string>
#include <vector>

#include "commands/bench.h"
#include "commands/probe.h"
#include "core/error.h"
#include "gl/context.h"
#include "gl/driver_rates.h"
#include "gl/program.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_options.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {
namespace {

void addValue(const ProbeLine& line, const std::string& name, double value, const char* unit) {
  line({{"case", name}, {"value", value}, {"unit", unit}});
}

// A configuration of the scene `pinned2`: those for which times were predicted (docs/gpu.md), and the one
// that a user gets, where many passes are dispatched for nothing, or are not.
struct Configuration {
  const char* name;
  std::vector<std::string> settings;
};
const std::vector<Configuration>& configurations() {
  static const std::vector<Configuration> all{
      {"plain", {"solver.strain_limit=false", "solver.self_collision=false"}},
      {"limiter", {"solver.strain_limit=0.1", "solver.self_collision=false"}},
      {"robust", {"solver.strain_limit=0.1", "solver.self_collision=robust"}},
      {"implicit",
       {"solver.strain_limit=false", "solver.self_collision=false", "solver.integrator=implicit",
        "solver.frames_per_sec=60", "solver.simulation_steps=1", "solver.newton_steps=4",
        "solver.cg_iterations=10"}},
      {"implicit with contact",
       {"cloth.material=cotton", "solver.strain_limit=false", "solver.self_collision=contact",
        "solver.integrator=implicit", "solver.frames_per_sec=60", "solver.simulation_steps=1",
        "solver.newton_steps=4", "solver.cg_iterations=10"}},
      {"implicit at the defaults",
       {"cloth.material=cotton", "solver.strain_limit=false", "solver.self_collision=contact",
        "solver.integrator=implicit", "solver.frames_per_sec=60", "solver.simulation_steps=auto"}}};
  return all;
}

Scene sceneOf(const Configuration& configuration, int size) {
  return readScene({"pinned2", GridSize{size, size}, configuration.settings, {}}).scene;
}

std::string sizeText(int size) { return std::to_string(size) + "x" + std::to_string(size); }

// What is too large for the driver is a line of its own.
template <class Measure>
void measureOrSay(const ProbeLine& line, const std::string& name, Measure measure) {
  try {
    measure();
  } catch (const OpenGlError& error) {
    line({{"case", name}, {"error", error.what()}});
  }
}

}  // namespace

void probeLimits(const ProbeLine& line) {
  const gl::ContextInfo info = gl::currentContextInfo();
  nlohmann::ordered_json json{{"vendor", info.vendor},
                              {"renderer", info.renderer},
                              {"version", info.version},
                              {"software", info.software}};
  for (const auto& [name, value] : gl::driverLimits()) json["limits"][name] = value;
  line(json);
}

void probeDispatches(bool small, const ProbeLine& line) {
  gl::measureDispatches(small, [&](const auto&... finding) { addValue(line, finding...); });
}

void probeRoofs(bool small, const ProbeLine& line) {
  gl::measureRoofs(small, [&](const auto&... finding) { addValue(line, finding...); });
}

void probePrograms(const ProbeLine& line) {
  std::size_t told = 0;
  const auto tellFrom = [&](const std::string& name) {
    const std::vector<gl::Compilation>& all = gl::compilations();
    for (; told < all.size(); ++told) addValue(line, name + ": " + all[told].program, all[told].seconds, "s");
  };
  for (const Configuration& configuration : configurations()) {
    const Scene scene = sceneOf(configuration, 33);
    const Cloth cloth(scene);
    const GpuSolver solver(cloth, scene);
    tellFrom(configuration.name);
  }
  const Scene demo = loadSceneByName("demo");
  const Cloth cloth(demo);
  const Renderer renderer(cloth, demo, {});
  tellFrom("drawing the demo");
}

void probeSteps(bool small, const std::string& only, const ProbeLine& line) {
  bool hasCases = false;
  for (const int size : small ? std::vector{32} : std::vector{128, 512, 1024})
    for (const Configuration& configuration : configurations()) {
      const std::string name = std::string(configuration.name) + " " + sizeText(size);
      if (name.find(only) == std::string::npos) continue;
      hasCases = true;
      measureOrSay(line, name, [&] {
        const Scene scene = sceneOf(configuration, size);
        const StepRate rate = measureStepRate(scene, "gpu", small ? 0.02 : 0.7);
        addValue(line, name, rate.secondsPerStep * 1e6, "us/step");
        if (scene.solver.simulationSteps.automatic)
          addValue(line, name + ", steps a frame", scene.solver.simulationSteps, "1/frame");
        addValue(line, name + ", submitting", rate.submitSecondsPerStep * 1e6, "us/step");
        addValue(line, name + ", dispatches", static_cast<double>(rate.dispatchesPerStep), "1/step");
        for (const PassTime& pass : rate.passes)
          addValue(line, name + ", pass " + pass.name, pass.seconds * 1e6, "us/step");
      });
    }
  if (!hasCases) complainNothingMatches(only);
}

void probeGroups(bool small, const ProbeLine& line) {
  const int size = small ? 32 : 1024;
  for (const std::size_t configuration : {0, 1}) {
    const Scene scene = sceneOf(configurations()[configuration], size);
    const Cloth cloth(scene);
    for (const auto& [columns, rows] :
         {std::pair{64, 1}, std::pair{128, 1}, std::pair{32, 4}, std::pair{32, 8}, std::pair{16, 16}}) {
      GpuSolver solver(cloth, scene, {.groupColumns = columns, .groupRows = rows});
      const gl::WorkTime time = gl::timeWork(small ? 2 : 200, [&] { solver.step(1); });
      addValue(line,
               std::string(configurations()[configuration].name) + " " + sizeText(size) + ", groups of " +
                   std::to_string(columns) + "x" + std::to_string(rows),
               time.seconds * 1e6, "us/step");
    }
  }
}

void probeDemo(bool small, const ProbeLine& line) {
  for (const int size : small ? std::vector{32} : std::vector{512, 1024}) {
    const DemoRate rate = small ? measureDemo(size, "gpu", 160, 90) : measureDemo(size, "gpu", 3840, 2160);
    addValue(line, "demo " + sizeText(size) + ", a 30th of a second", rate.simulationSeconds * 1e3, "ms");
    addValue(line, "demo " + sizeText(size) + (small ? ", drawn at 160x90" : ", drawn at 3840x2160"),
             rate.drawSeconds * 1e3, "ms");
  }
}

}  // namespace clothsim
