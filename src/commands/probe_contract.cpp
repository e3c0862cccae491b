// Whether a driver keeps to the numeric contract (docs/numeric-contract.md), and where not.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/probe.h"
#include "core/interrupt.h"
#include "gl/buffer.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_options.h"
#include "simulation/compare.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {
namespace {

struct ContractCase {
  std::string name;
  Scene scene;
  int steps = 1;
  bool isCut = false;
  GpuOptions options{};
};

// Runs lists that are not whole steps.
class PartialSolver final : public Solver {
 public:
  using Solver::Solver;
  [[nodiscard]] State after(const PassList& list) {
    executor().run(inputs(), list, 1);
    State state;
    executor().download(state);
    return state;
  }
};

// Of an explicit step: the pass after which the new positions or velocities differ first, with the passes
// before it that make them. Each pass is a dispatch of its own for that.
std::string firstDifferingPass(const ContractCase& of, const Cloth& cloth, const State& equal) {
  GpuOptions options = of.options;
  options.fused = false;
  PartialSolver gpu(cloth, of.scene, std::make_unique<GpuExecutor>(cloth, options));
  PartialSolver cpu(cloth, of.scene, std::make_unique<CpuExecutor<float>>(cloth, false));
  const PassList whole = gpu.passes();
  bool hasNewState = false;
  std::size_t first = 0;
  for (std::size_t count = 1; count <= whole.passes.size(); ++count) {
    hasNewState = hasNewState || whole.passes[count - 1].pass == Pass::integrate;
    if (!hasNewState) continue;
    PassList part = whole;
    part.passes.resize(count);
    part.findGateEnds();
    gpu.setState(equal);
    cpu.setState(equal);
    if (difference(cpu.after(part), gpu.after(part)).differing > 0)
      return nameOf(std::span(whole.passes).subspan(first, count - first));
    first = count;
  }
  return "none alone; only where passes share a dispatch";
}

// Of an implicit step, whose passes leave the state alone until its end: after how little of its work it
// differs.
std::string firstDifferingIteration(const ContractCase& of, const Cloth& cloth, const State& equal) {
  const SolverSettings& settings = of.scene.solver;
  GpuSolver gpu(cloth, of.scene, of.options);
  CpuSolver<float> cpu(cloth, of.scene);
  for (int newton = 1; newton <= settings.newtonSteps; ++newton)
    for (int iteration = 1; iteration <= settings.cgIterations; ++iteration) {
      Scene scene = of.scene;
      scene.solver.newtonSteps = newton;
      scene.solver.cgIterations = iteration;
      for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) {
        solver->configure(scene);  // which compiles nothing anew
        solver->setState(equal);
        solver->step(1);
      }
      stopIfInterrupted();
      if (difference(cpu.state(), gpu.state()).differing > 0)
        return "Newton step " + std::to_string(newton) + ", iteration " + std::to_string(iteration);
    }
  return "none of a step on its own";
}

// Repeats steps one by one, from the last state that was equal.
void findFirst(const ContractCase& of, const Cloth& cloth, Solver& cpu, Solver& gpu, State equal, int steps,
               nlohmann::ordered_json& json) {
  cpu.setState(equal);
  gpu.setState(equal);
  for (int step = 0; step < steps; ++step) {
    cpu.step(1);
    gpu.step(1);
    stopIfInterrupted();
    const State onCpu = cpu.state();
    if (difference(onCpu, gpu.state()).differing > 0) {
      json["first_differing_step"] = onCpu.clock.step;
      json["pass"] = gpu.passes().contains(Pass::begin) ? firstDifferingIteration(of, cloth, equal)
                                                        : firstDifferingPass(of, cloth, equal);
      return;
    }
    equal = onCpu;
  }
  json["first_differing_step"] = nullptr;  // not when the steps are repeated from a state
}

bool compareCase(const ContractCase& of, const ProbeLine& line) {
  const Cloth cloth(of.scene);
  CpuSolver<float> cpu(cloth, of.scene);
  GpuSolver gpu(cloth, of.scene, of.options);
  if (of.isCut) {
    const Piece& piece = cloth.pieces()[0];
    Cuts cuts;
    cutAlong(cuts, cloth, 0, {-1, piece.rows / 2 - 0.5}, {0.6 * piece.columns, piece.rows / 2 + 0.4});
    cpu.setCuts(cuts);
    gpu.setCuts(cuts);
  }
  const int steps = of.steps, atOnce = std::min<int>(steps, of.scene.solver.simulationSteps);
  nlohmann::ordered_json json{{"case", of.name}, {"particles", cloth.particleCount()}};
  State equal = cpu.state();
  StateDifference found = difference(equal, gpu.state());
  int done = 0;
  for (int count = 0; done < steps && found.differing == 0 && found.finite; done += count) {
    count = std::min(atOnce, steps - done);
    gpu.step(count);
    cpu.step(count);
    stopIfInterrupted();  // one of them may have taken fewer steps
    State onCpu = cpu.state();
    found = difference(onCpu, gpu.state());
    if (found.differing > 0) findFirst(of, cloth, cpu, gpu, equal, count, json);
    equal = std::move(onCpu);
  }
  const bool isSound = found.differing == 0 && found.finite && cpu.divergence() == gpu.divergence();
  json.update(nlohmann::ordered_json{{"steps", done},
                                     {"floats", found.floats},
                                     {"differing_floats", found.differing},
                                     {"max_abs_difference", found.maxAbs},
                                     {"equal", isSound}});
  line(json);
  return isSound;
}

Scene sceneWith(const std::string& name, int size, const std::vector<std::string>& settings) {
  return readScene({name, size > 0 ? std::optional(GridSize{size, size}) : std::nullopt, settings, {}}).scene;
}

// At its own size, or at 20 x 20 points.
Scene bundledScene(const std::string& name, bool small) {
  const Scene scene = loadSceneByName(name);
  const bool hasGrid = std::any_of(scene.cloths.begin(), scene.cloths.end(),
                                   [](const ClothSettings& cloth) { return !cloth.isMesh(); });
  return small && hasGrid ? sceneWith(name, 20, {}) : scene;
}

}  // namespace

bool probeContract(bool small, const std::string& only, const ProbeLine& line) {
  gl::uninitialisedWord = 0x3f800000u;  // 1
  const int frames = small ? 1 : 10, size = small ? 20 : 64, large = small ? 40 : 512;
  bool isEqual = true, hasCases = false;
  const auto compare = [&](const ContractCase& one) {
    if (one.name.find(only) == std::string::npos) return;
    hasCases = true;
    isEqual = compareCase(one, line) && isEqual;
  };
  const auto inFrames = [&](const std::string& name, const Scene& scene) {
    return ContractCase{name, scene, frames * scene.solver.simulationSteps};
  };
  for (const std::string& name : bundledNames())
    compare(inFrames("scene " + name, bundledScene(name, small)));
  for (const char* integrator : {"implicit", "bdf2"})
    for (const char* name : {"pinned2", "sphere", "selfCollision", "cs171"})
      compare(
          inFrames(std::string(name) + ", " + integrator,
                   sceneWith(name, small ? 20 : 0,
                             {std::string("solver.integrator=") + integrator, "solver.simulation_steps=4"})));
  const std::vector<std::string> everything{"solver.strain_limit=0.1", "solver.self_collision=robust"},
      implicitly{"solver.integrator=implicit", "solver.frames_per_sec=60", "solver.simulation_steps=1"};
  ContractCase cut = inFrames("cut, explicit", sceneWith("pinned2", size, everything));
  cut.isCut = true;
  compare(cut);
  cut = inFrames("cut, implicit", sceneWith("pinned2", size, implicitly));
  cut.isCut = true;
  compare(cut);
  for (const auto& [columns, rows] : {std::pair{32, 8}, std::pair{16, 16}, std::pair{128, 1}})
    for (const auto* settings : {&everything, &implicitly}) {
      ContractCase grouped = inFrames("groups of " + std::to_string(columns) + "x" + std::to_string(rows) +
                                          (settings == &everything ? ", explicit" : ", implicit"),
                                      sceneWith("pinned2", size, *settings));
      grouped.options.groupColumns = columns;
      grouped.options.groupRows = rows;
      compare(grouped);
    }
  const std::string largeSize = std::to_string(large) + "x" + std::to_string(large);
  compare({"large, " + largeSize + ", explicit", sceneWith("pinned2", large, everything), small ? 2 : 20});
  compare({"large, " + largeSize + ", implicit", sceneWith("pinned2", large, implicitly), small ? 1 : 4});
  if (!hasCases) complainNothingMatches(only);
  return isEqual;
}

}  // namespace clothsim
