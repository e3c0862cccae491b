#include "commands/bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "core/error.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/timer.h"
#include "render/draw_scale.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "simulation/gpu/simulation_renderer.h"
#include "simulation/gpu/solvers.h"
#include "solver/cpu/roof.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int REPETITIONS = 7;
constexpr int ADAPTING_PICTURES = 24;
constexpr double DEMO_FRAME = 1.0 / 30;  // [s]

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double timeSteps(Solver& solver, int steps) {
  const Clock::time_point start = Clock::now();
  solver.step(steps);
  solver.finish();
  return secondsSince(start);
}

// Some drivers compile shaders in the first steps, and a GPU that was idle takes a while to reach its clock
// rate.
void warmUp(Solver& solver, const std::string& backend) {
  constexpr double seconds = 0.1;
  timeSteps(solver, 2);
  if (backend != "gpu" || gl::currentContextInfo().software) return;
  for (double spent = 0; spent < seconds;) spent += timeSteps(solver, 16);
}

// Timings of a simulation that has blown up mean nothing.
void checkSound(Solver& solver, const Cloth& cloth, const Scene& scene) {
  if (const std::optional<Divergence> divergence = solver.divergence())
    throw SimulationError(blowUpText(*divergence, cloth, scene));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

namespace {

// Of few steps at a time, so that no queue of the driver is full.
double timeSubmitting(Solver& solver, std::uint64_t dispatches) {
  const int steps =
      static_cast<int>(std::clamp<std::uint64_t>(512 / std::max<std::uint64_t>(dispatches, 1), 1, 64));
  std::vector<double> times;
  for (int i = 0; i < REPETITIONS; ++i) {
    solver.finish();
    const Clock::time_point start = Clock::now();
    solver.step(steps);
    times.push_back(secondsSince(start) / steps);
  }
  solver.finish();
  return median(times);
}

// Bytes that are taken from the system's heap; 0 where it does not say.
std::size_t heapBytes() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

// The least that a step has to read and write: positions, velocities and inverse masses; new ones of the
// first two.
constexpr double STEP_BYTES = 13 * sizeof(float);

// Multiplications, additions and comparisons of the laws, each spring once.
double operationsPerParticle(const Scene& scene, const Cloth& cloth) {
  constexpr double spring = 33;  // 27 for its force (force_laws.h), 6 to add it at both ends
  constexpr double limit = 9;    // its squared length, and the look at it
  constexpr double rest = 26;    // 7 for each of three components of the integration, 5 for its watch
  if (isImplicit(scene.solver.integrator)) return 0;
  const auto springs = static_cast<double>(cloth.springs().size()) / cloth.particleCount();
  return springs * (scene.solver.strainLimit ? spring + limit : spring) + rest;
}

std::string pointsText(const Piece& piece) {
  return piece.isMesh ? std::to_string(piece.particleCount())
                      : std::to_string(piece.columns) + "x" + std::to_string(piece.rows);
}

}  // namespace

double StepRate::memoryShare() const {
  return operationsPerParticle > 0 ? STEP_BYTES * particleStepsPerSecond / copiedBytesPerSecond : 0;
}
double StepRate::arithmeticShare() const {
  return operationsPerParticle * particleStepsPerSecond / operationsPerSecond;
}

StepRate measureStepRate(const Scene& scene, const std::string& backend, double seconds, const State& state) {
  const Shared<Cloth> sharedCloth = Cloth(scene);
  const Cloth& cloth = *sharedCloth;
  const std::size_t heapBefore = heapBytes();
  const std::unique_ptr<Solver> solver = makeSolver(backend, sharedCloth, scene);
  if (!state.positions.empty()) solver->setState(state);
  warmUp(*solver, backend);
  const std::uint64_t dispatchesBefore = gl::dispatchCount();
  timeSteps(*solver, 1);
  const std::uint64_t dispatches = gl::dispatchCount() - dispatchesBefore;
  const double once = std::max(1e-6, timeSteps(*solver, 4) / 4);
  const int steps = std::clamp(static_cast<int>(seconds / REPETITIONS / once), 1, 20000);
  std::vector<double> times;
  for (int i = 0; i < REPETITIONS; ++i) times.push_back(timeSteps(*solver, steps) / steps);

  checkSound(*solver, cloth, scene);

  StepRate rate;
  rate.backend = backend;
  rate.device = solver->device();
  rate.points = pointsText(cloth.pieces()[0]);
  rate.cloths = cloth.pieces().size();
  rate.limiter = scene.solver.strainLimit.has_value();
  rate.selfCollision = scene.solver.selfCollision;
  rate.repetitions = REPETITIONS;
  rate.secondsPerStep = median(times);
  if (dispatches > 0) rate.submitSecondsPerStep = timeSubmitting(*solver, dispatches);
  rate.dispatchesPerStep = dispatches;
  rate.particleStepsPerSecond = cloth.particleCount() / rate.secondsPerStep;
  if (backend == "cpu") {
    const std::size_t bytes = heapBytes() - heapBefore;
    rate.bytesPerParticle = static_cast<double>(bytes) / cloth.particleCount();
    rate.copiedBytesPerSecond = cpu::measureCopying(std::max<std::size_t>(bytes, 1 << 16));
    rate.operationsPerSecond = cpu::measureArithmetic();
    rate.operationsPerParticle = operationsPerParticle(scene, cloth);
  }
  const int timed = std::clamp(steps, 1, 20);
  rate.passes = solver->timePasses(timed);
  for (PassTime& pass : rate.passes) pass.seconds /= timed;
  return rate;
}

DrawRate measureDrawing(const Scene& scene, const State& state, Quality quality, int width, int height,
                        int repetitions) {
  const Cloth cloth(scene);
  const gl::Buffer<Particle4> positions("positions to draw", state.positions);
  const bool software = gl::currentContextInfo().software;
  Renderer renderer(cloth, scene, withQuality({}, quality, software));
  DrawScale scale(software ? pictureBudget(quality) : 0);
  const Camera camera(scene, cloth);
  const gl::Framebuffer target("bench", {.width = width, .height = height, .color = GL_RGBA8});
  DrawRate rate;
  rate.shader = scene.render.shader;
  rate.quality = quality;
  gl::Timer timer;
  const auto draw = [&] {
    renderer.setScale(scale.scale());
    timer.begin();
    renderer.draw(positions.name(), camera, 0, target.name(), width, height);
    timer.end();
    return timer.seconds();
  };
  draw();  // compiles shaders
  for (int i = 0; i < ADAPTING_PICTURES && software; ++i) scale.drawn(draw());
  rate.scale = scale.scale();
  std::vector<double> whole, processor;
  std::vector<std::vector<double>> passes;
  for (int i = 0; i < repetitions; ++i) {
    const std::clock_t before = std::clock();
    whole.push_back(draw());
    processor.push_back(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    rate.passes = renderer.timeDraw(positions.name(), camera, 0, target.name(), width, height);
    passes.resize(rate.passes.size());
    for (std::size_t pass = 0; pass < passes.size(); ++pass)
      passes[pass].push_back(rate.passes[pass].seconds);
  }
  rate.seconds = median(whole);
  rate.leastSeconds = *std::min_element(whole.begin(), whole.end());
  rate.processorSeconds = median(processor);
  for (std::size_t pass = 0; pass < passes.size(); ++pass) rate.passes[pass].seconds = median(passes[pass]);
  return rate;
}

DemoRate measureDemo(int size, const std::string& backend, int width, int height) {
  Scene scene = loadSceneByName("demo");
  (void)changeResolution(scene, size, size, false);
  Simulation simulation(scene, backend, makeSolver);
  DemoRate rate;
  rate.size = size;
  const int steps = std::max(1, static_cast<int>(std::lround(DEMO_FRAME / stepLength(scene.solver))));
  warmUp(simulation.solver(), backend);
  const int timed = std::min(steps, 64);
  rate.simulationSeconds = timeSteps(simulation.solver(), timed) * steps / timed;
  checkSound(simulation.solver(), simulation.cloth(), scene);
  if (width == 0) return rate;

  SimulationRenderer renderer(simulation, {});
  const Camera camera(scene, simulation.cloth());
  const gl::Framebuffer target(
      "bench", {.width = width, .height = height, .color = GL_SRGB8_ALPHA8, .depth = GL_DEPTH_COMPONENT24});
  const auto draw = [&] {
    const Clock::time_point start = Clock::now();
    renderer.draw(camera, target.name(), width, height);
    simulation.finish();
    return secondsSince(start);
  };
  draw();
  rate.drawSeconds = median({draw(), draw(), draw()});
  return rate;
}

DemoRate largestRealTimeDemo(const std::string& backend, int width, int height) {
  constexpr int grain = 16;
  DemoRate best;
  int low = 0, high = 1;  // in multiples of 16: doubled until one is too slow, then bisected
  const auto holds = [&](int grains) {
    const DemoRate rate = measureDemo(grains * grain, backend, width, height);
    if (rate.perFrame() > DEMO_FRAME) return false;
    best = rate;
    return true;
  };
  while (high * grain <= 4096 && holds(high)) low = std::exchange(high, 2 * high);
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return best;
}

}  // namespace clothsim
