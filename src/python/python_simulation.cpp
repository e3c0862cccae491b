#include "python/python_simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>
#include <utility>

#include "core/error.h"
#include "export/export.h"
#include "render/camera.h"
#include "scene/moved_collider.h"
#include "scene/pose.h"
#include "scene_io/scene_io.h"
#include "session/action_checks.h"
#include "session/carry_over.h"
#include "simulation/gpu/solvers.h"

namespace clothsim {
namespace {

// All simulations of the process share one context, which belongs to the thread that was first to need it.
// Threads come here at once, since the interpreter lets others run while a simulation is made.
struct SharedContext {
  std::mutex mutex;
  std::weak_ptr<gl::HeadlessContext> context;
  std::thread::id thread;
};

// Null where another thread has it. @throws OpenGlError
std::shared_ptr<gl::HeadlessContext> contextOfThisThread() {
  static SharedContext shared;
  const std::lock_guard lock(shared.mutex);
  const bool isHere = shared.thread == std::this_thread::get_id();
  if (std::shared_ptr<gl::HeadlessContext> context = shared.context.lock()) return isHere ? context : nullptr;
  const auto context = std::make_shared<gl::HeadlessContext>();
  shared.context = context;
  shared.thread = std::this_thread::get_id();
  return context;
}

constexpr double radians = std::numbers::pi / 180;  // in a degree

}  // namespace

// One caller at a time, on the thread of the context where there is one.
class PythonSimulation::Turn {
 public:
  explicit Turn(PythonSimulation& simulation) : simulation_(simulation) {
    if (simulation.isBusy_.test_and_set())
      throw UsageError("another thread uses this simulation; make one for each thread");
    if (simulation.context_ && !simulation.isContextHere()) {
      simulation.isBusy_.clear();
      throw UsageError(
          "this simulation uses OpenGL, which belongs to the thread that first used it; call it from there, "
          "or make a simulation with backend=\"cpu\" for this thread");
    }
  }
  ~Turn() { simulation_.isBusy_.clear(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  PythonSimulation& simulation_;
};

PythonSimulation::PythonSimulation(RemarkedScene read, const std::string& backend, double jitter,
                                   std::uint32_t seed)
    : scene_(std::move(read.scene)),
      backend_(backend),
      jitter_(jitter),
      seed_(seed),
      remarks_(std::move(read.remarks)) {
  if (backend != "auto" && backend != "cpu" && backend != "gpu")
    throw UsageError("backend: expected auto, cpu or gpu, found \"" + backend + "\"");
  if (!(jitter >= 0 && jitter <= 1)) throw UsageError("jitter: expected 0 to 1 m");
  if (backend == "gpu") needContext();
  if (backend == "auto") chooseBackend();
  start(seed);
  particles_ = simulation_->cloth().particleCount();
  triangles_ = simulation_->cloth().lists().triangles.size();
}

// The CPU, too, where another thread of the process has OpenGL.
void PythonSimulation::chooseBackend() {
  backend_ = "cpu";
  try {
    if (takeContext()) backend_ = chosenBackend("auto");
  } catch (const OpenGlError&) {  // there is none
  }
  if (backend_ == "cpu") context_.reset();
}

PythonSimulation::~PythonSimulation() {
  // Objects of OpenGL cannot be freed on another thread; they go with the process.
  if (!context_ || isContextHere()) return;
  static_cast<void>(renderer_.release());
  new std::shared_ptr<Simulation>(simulation_);
  new std::shared_ptr<gl::HeadlessContext>(context_);
}

bool PythonSimulation::isContextHere() const { return contextThread_ == std::this_thread::get_id(); }

bool PythonSimulation::takeContext() {
  if (!context_) context_ = contextOfThisThread();
  contextThread_ = std::this_thread::get_id();
  return context_ != nullptr;
}

void PythonSimulation::needContext() {
  if (!takeContext()) throw UsageError("OpenGL is used by another thread of this process; call from there");
}

void PythonSimulation::start(const std::optional<std::uint32_t>& seed) {
  const auto simulation = std::make_shared<Simulation>(scene_, backend_, makeSolver);
  if (jitter_ > 0) {
    State jittered = simulation->state();
    jitter(jittered, jitter_, seed.value_or(seed_));
    simulation->setState(jittered);
  }
  simulation->solver().convertVelocities();
  RunSummary summary;
  summary.add(*simulation);
  renderer_.reset();  // before its simulation goes
  simulation_ = simulation;
  stepsSinceKept_ = 0;
  ways_.clear();
  summary_ = std::move(summary);
  lookers_ = std::make_shared<std::shared_ptr<Simulation>>(simulation_);
  positionsPlace_ = velocitiesPlace_ = nullptr;
  forces_.reset();
  remarkOfState_.clear();
}

std::string PythonSimulation::device() {
  const Turn turn(*this);
  return simulation_->solver().device();
}

State PythonSimulation::state() {
  const Turn turn(*this);
  return readState();
}

State PythonSimulation::readState() {
  State state = simulation_->state();
  stayInPlace();
  return state;
}

double PythonSimulation::time() {
  const Turn turn(*this);
  return simulation_->time();
}

int PythonSimulation::frame() {
  const Turn turn(*this);
  return frameNow();
}

int PythonSimulation::frameNow() const {
  return static_cast<int>(std::lround(simulation_->time() * simulation_->scene().solver.framesPerSec));
}

// Steps may have had other lengths before.
int PythonSimulation::wholeFrames() const {
  constexpr double rounding = 1e-6;
  return static_cast<int>(
      std::floor(simulation_->time() * simulation_->scene().solver.framesPerSec + rounding));
}

Scene PythonSimulation::scene() {
  const Turn turn(*this);
  return simulation_->scene();
}

std::string PythonSimulation::text() {
  std::string now;
  try {
    now = std::to_string(time()) + " s";
  } catch (const UsageError&) {
    now = "in use by another thread";
  }
  return "<clothsim.Simulation: " + std::to_string(particles_) + " particles, " + backend_ + ", " + now + ">";
}

// A divergence goes back by a frame at most: who asks for single steps pays for the copy once a frame.
void PythonSimulation::advance(std::int64_t steps, const std::function<void()>& poll) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds pollTime{50};
  while (steps > 0) {
    restArrivedColliders();
    const SolverSettings& solver = simulation_->scene().solver;
    const std::int64_t whole = solver.simulationSteps,
                       frame = std::min({steps, whole - stepsSinceKept_,
                                         ways_.stepsLeft(simulation_->time(), stepLength(solver))});
    if (stepsSinceKept_ == 0) simulation_->keep();
    for (std::int64_t done = 0; done < frame;) {
      const int count = static_cast<int>(std::min<std::int64_t>(stepsAtOnce_, frame - done));
      const Clock::time_point start = Clock::now();
      simulation_->step(count);
      simulation_->finish();
      const Clock::duration taken = Clock::now() - start;
      done += count;
      if (taken > pollTime)
        stepsAtOnce_ = std::max(1, count / 2);
      else if (taken < pollTime / 4 && count == stepsAtOnce_ && stepsAtOnce_ < 1 << 20)
        stepsAtOnce_ *= 2;
      poll();
    }
    const std::int64_t since = std::exchange(stepsSinceKept_, 0) + frame;
    if (const std::optional<Divergence> divergence = simulation_->checkFrame())
      throw SimulationError(
          blowUpText(*divergence, simulation_->cloth(), simulation_->scene(), wholeFrames() + 1) +
          "\nThe state is the one before that frame.");
    if (since < whole) stepsSinceKept_ = since;
    steps -= frame;
  }
  restArrivedColliders();
}

void PythonSimulation::restArrivedColliders() {
  const Scene& scene = simulation_->scene();
  if (std::optional<Scene> rest = ways_.arrived(scene, simulation_->time(), stepLength(scene.solver))) {
    simulation_->configure(std::move(*rest));
    stepsSinceKept_ = 0;
  }
}

void PythonSimulation::step(std::int64_t steps, const std::function<void()>& poll) {
  if (steps < 0) throw UsageError("steps: expected 0 or more, found " + std::to_string(steps));
  const Turn turn(*this);
  stepSoundly(steps, poll);
}

void PythonSimulation::stepSoundly(std::int64_t steps, const std::function<void()>& poll) {
  try {
    advance(steps, poll);
  } catch (...) {
    stayInPlace();
    throw;
  }
  stayInPlace();
}

namespace {

void checkFrames(std::int64_t frames) {
  constexpr std::int64_t most = 10'000'000;  // as run --frames
  if (frames < 0 || frames > most)
    throw UsageError("frames: expected 0 to 10000000, found " + std::to_string(frames));
}

}  // namespace

void PythonSimulation::stepFrames(std::int64_t frames, const std::function<void()>& poll) {
  checkFrames(frames);
  const Turn turn(*this);
  stepSoundly(frames * simulation_->scene().solver.simulationSteps, poll);
}

Trace PythonSimulation::run(std::int64_t frames, const std::function<void()>& poll) {
  checkFrames(frames);
  Trace trace;
  for (std::int64_t done = 0;; ++done) {
    {
      const Turn turn(*this);
      measureNow();
      stayInPlace();
      trace.add(summary_, *simulation_);
    }
    if (done >= frames) return trace;
    stepFrames(1, poll);
  }
}

void PythonSimulation::reset(std::optional<std::uint32_t> seed) {
  const Turn turn(*this);
  start(seed);
}

void PythonSimulation::setState(const State& state) {
  const Turn turn(*this);
  takeState(state, "set_state");
}

void PythonSimulation::takeState(const State& state, const std::string& source) {
  const std::string remark = remarkOfState(state, simulation_->cloth());
  remarkOfState_ = remark.empty() ? "" : source + ": " + remark;
  simulation_->setState(state);
  simulation_->solver().convertVelocities();
  stepsSinceKept_ = 0;
  stayInPlace();
}

void PythonSimulation::setPins(std::span<const bool> pinned) {
  const Turn turn(*this);
  State state = simulation_->state();
  for (std::uint32_t i = 0; i < pinned.size(); ++i) {
    float& inverseMass = state.positions[i].w;
    if (pinned[i] == (inverseMass == 0)) continue;
    inverseMass = pinned[i] ? 0 : static_cast<float>(1 / simulation_->cloth().massOf(i));
    state.velocities[i] = {};
    leavePath(state.offPath, i);
  }
  forgetHistory(state);
  simulation_->setState(state);
  stepsSinceKept_ = 0;
  stayInPlace();
}

void PythonSimulation::setForces(std::vector<Particle4> forces) {
  const Turn turn(*this);
  forces_ = forces.empty() ? nullptr : std::make_shared<const std::vector<Particle4>>(std::move(forces));
  Interaction interaction;
  interaction.externalForces = forces_;
  simulation_->solver().setInteraction(interaction);
}

void PythonSimulation::moveCollider(std::size_t collider, Vec3d position, std::optional<double> seconds) {
  const Turn turn(*this);
  checkAction(MoveCollider{collider, position}, simulation_->cloth(), simulation_->scene());
  sendCollider("move_collider", {collider, position}, seconds);
}

void PythonSimulation::turnCollider(std::size_t collider, Vec3d degrees, std::optional<double> seconds) {
  const Turn turn(*this);
  checkAction(TurnCollider{collider, degrees}, simulation_->cloth(), simulation_->scene());
  sendCollider("turn_collider", {collider, std::nullopt, rotationMatrix(degrees)}, seconds);
}

void PythonSimulation::sendCollider(const std::string& name, const ColliderMove& move,
                                    std::optional<double> seconds) {
  const Scene& scene = simulation_->scene();
  const double duration = seconds.value_or(1 / scene.solver.framesPerSec), now = simulation_->time();
  if (!(duration > 0 && duration <= 1e6))
    throw UsageError(name + ": seconds: expected more than 0 and up to 1e6");
  simulation_->configure(ways_.sent(scene, move, now, now + duration));
  stepsSinceKept_ = 0;
}

std::shared_ptr<const std::vector<Particle4>> PythonSimulation::forces() {
  const Turn turn(*this);
  return forces_;
}

std::vector<Vec3d> PythonSimulation::colliderPositions() {
  const Turn turn(*this);
  std::vector<Vec3d> positions;
  for (const Collider& collider : simulation_->scene().colliders)
    positions.push_back(poseAt(collider, simulation_->time()).position);
  return positions;
}

void PythonSimulation::configure(const std::vector<std::string>& settings) {
  const Turn turn(*this);
  Scene scene = simulation_->scene();
  for (const std::string& setting : settings) {
    setSceneValue(scene, setting, "set");
    if (needsRebuild(simulation_->scene(), scene))
      throw UsageError(
          "set " + setting +
          ": this key makes another cloth, which a running simulation cannot change to; give it to "
          "Simulation() instead");
  }
  simulation_->configure(std::move(scene));
  simulation_->solver().convertVelocities();  // the bits must not depend on when the state is read
  stepsSinceKept_ = 0;
  stayInPlace();
}

void PythonSimulation::measureNow() { summary_.add(*simulation_, frameNow()); }

std::string PythonSimulation::measures() {
  const Turn turn(*this);
  measureNow();
  stayInPlace();
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  summary_.write(json, *simulation_);
  return json.dump();
}

Image PythonSimulation::picture(const PictureView& view) {
  if (view.width < 16 || view.height < 16 || view.width > 8192 || view.height > 8192)
    throw UsageError("render: expected 16 x 16 to 8192 x 8192 pixels, found " + std::to_string(view.width) +
                     " x " + std::to_string(view.height));
  if (!(std::abs(view.right) <= 360) || !(std::abs(view.up) <= 180) ||
      !(view.zoom >= 0.01 && view.zoom <= 100))
    throw UsageError("render: view: expected (right, up, zoom) in degrees and a factor from 0.01 to 100");
  if (view.exposures < 1 || view.exposures > MOST_EXPOSURES)
    throw UsageError("render: expected 1 to " + std::to_string(MOST_EXPOSURES) + " exposures, found " +
                     std::to_string(view.exposures));
  const Turn turn(*this);
  needContext();
  const RenderOptions drawing =
      forExposures(withQuality({}, Quality::final, gl::currentContextInfo().software), view.exposures);
  if (!renderer_)
    renderer_ = std::make_unique<SimulationRenderer>(*simulation_, drawing);
  else
    renderer_->setOptions(drawing);
  Camera camera = pictureCamera(simulation_->scene(), simulation_->cloth(), view.width, view.height);
  camera.orbit(view.right * radians, view.up * radians);
  camera.zoom(1 / view.zoom);
  Image image = renderer_->picture(camera, view.width, view.height, view.exposures);
  stayInPlace();
  return image;
}

void PythonSimulation::save(const std::filesystem::path& path) {
  const Turn turn(*this);
  saveState(readState(), simulation_->cloth(), path, &simulation_->scene());
}
void PythonSimulation::load(const std::filesystem::path& path) {
  const Turn turn(*this);
  takeState(loadState(path, simulation_->cloth()), path.string());
}

std::vector<std::string> PythonSimulation::remarks() {
  const Turn turn(*this);
  std::vector<std::string> remarks = remarks_;
  if (!remarkOfState_.empty()) remarks.push_back(remarkOfState_);
  return remarks;
}

std::vector<std::array<std::uint32_t, 3>> PythonSimulation::faces() {
  const Turn turn(*this);
  return remainingTriangles(simulation_->cloth(), simulation_->solver().cuts());
}

std::optional<SharedParticles> PythonSimulation::memory() {
  const Turn turn(*this);
  auto* solver = dynamic_cast<CpuSolver<float>*>(&simulation_->solver());
  if (solver == nullptr) return std::nullopt;
  solver->convertVelocities();
  stayInPlace();
  const Components<float>&positions = solver->particles().positions,
        &velocities = solver->particles().velocities;
  positionsPlace_ = positions.x.data();
  velocitiesPlace_ = velocities.x.data();
  return SharedParticles{particles_,
                         {positionsPlace_, positions.distance()},
                         {velocitiesPlace_, velocities.distance()},
                         solver->inverseMasses().data(),
                         lookers_};
}

void PythonSimulation::stayInPlace() {
  if (lookers_.use_count() == 1 || positionsPlace_ == nullptr) return;
  if (auto* solver = dynamic_cast<CpuSolver<float>*>(&simulation_->solver()))
    solver->returnTo(positionsPlace_, velocitiesPlace_);
}

}  // namespace clothsim
