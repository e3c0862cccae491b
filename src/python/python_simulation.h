// A simulation as Python sees it: Simulation and what belongs to it - an OpenGL context where one is needed,
// measures, a renderer. It knows nothing of Python; module.cpp translates.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "gl/context.h"
#include "python/collider_ways.h"
#include "render/image.h"
#include "scene/moved_collider.h"
#include "scene_io/scene_options.h"
#include "simulation/gpu/simulation_renderer.h"
#include "simulation/run_summary.h"
#include "simulation/simulation.h"
#include "simulation/trace.h"
#include "solver/cpu/cpu_solver.h"

namespace clothsim {

// A picture's camera, as `render --view` takes it.
struct PictureView {
  int width = 1280, height = 720;      // [pixels]
  double right = 0, up = 0, zoom = 1;  // [degrees], and a factor
  int exposures = 1;                   // of which it is the mean (render/exposure.h)
};

// Particles in the memory of a simulation, for as long as somebody keeps `keeper`: also after reset(), and
// until then steps leave them at the same place.
struct SharedParticles {
  struct Rows {
    const float* first = nullptr;  // x of the first particle
    std::size_t distance = 0;      // from there to its y, and to its z [floats]
  };
  std::size_t count = 0;
  Rows positions, velocities;
  const float* inverseMasses = nullptr;
  std::shared_ptr<const void> keeper;
};

// One thread at a time may call it, for others its functions throw UsageError; on the GPU, and once it has
// drawn, only the thread that made it. What never changes anybody may ask for: backend() and the numbers of
// particles and triangles. All functions throw what the program would report.
class PythonSimulation {
 public:
  // Displaces free particles by up to `jitter` [m] at random, as `run --jitter --seed` does. `backend`: auto,
  // cpu or gpu.
  PythonSimulation(RemarkedScene read, const std::string& backend, double jitter, std::uint32_t seed);
  ~PythonSimulation();
  PythonSimulation(const PythonSimulation&) = delete;
  PythonSimulation& operator=(const PythonSimulation&) = delete;

  [[nodiscard]] const std::string& backend() const { return backend_; }  // cpu or gpu
  [[nodiscard]] std::size_t particles() const { return particles_; }
  [[nodiscard]] std::size_t triangles() const { return triangles_; }  // at the start, without cuts
  // Of the scene, and of the state that was loaded last, until reset().
  [[nodiscard]] std::vector<std::string> remarks();
  [[nodiscard]] std::string device();
  [[nodiscard]] State state();
  [[nodiscard]] double time();       // [s]
  [[nodiscard]] int frame();         // of the time that has passed, in whole frames
  [[nodiscard]] Scene scene();       // as it is now
  [[nodiscard]] std::string text();  // for people; never throws UsageError

  // Steps or frames. `poll` is called some ten times a second and ends the steps by throwing; the state is
  // then that after some whole step. A simulation that blows up goes back to the start of the frame.
  // @throws SimulationError
  void step(std::int64_t steps, const std::function<void()>& poll);
  void stepFrames(std::int64_t frames, const std::function<void()>& poll);
  // The same, measured at its beginning and after every frame.
  [[nodiscard]] Trace run(std::int64_t frames, const std::function<void()>& poll);

  // To the start of the scene as it was given; edits, pins and all else are gone.
  void reset(std::optional<std::uint32_t> seed);
  // Continues with this state.
  void setState(const State& state);
  // Pins free particles where they are and frees pinned ones, as the mouse does in the viewer.
  void setPins(std::span<const bool> pinned);
  // Forces on each particle, xyz [N], from the next step on until others are set; empty: none.
  void setForces(std::vector<Particle4> forces);
  [[nodiscard]] std::shared_ptr<const std::vector<Particle4>> forces();  // null: none
  // Moves a collider straight to a place within `seconds`; it stays there.
  void moveCollider(std::size_t collider, Vec3d position, std::optional<double> seconds);
  // Turns a collider about its origin or point, by a rotation vector [degrees], within `seconds`.
  void turnCollider(std::size_t collider, Vec3d degrees, std::optional<double> seconds);
  [[nodiscard]] std::vector<Vec3d> colliderPositions();
  // Live keys of the scene, as "key=value". @throws UsageError for a key that makes another cloth
  void configure(const std::vector<std::string>& settings);

  // What `run --json` prints of the state, as JSON; peaks and warnings are those of the frames that were
  // measured, which are the start and those at which this or run() was called.
  [[nodiscard]] std::string measures();
  [[nodiscard]] Image picture(const PictureView& view);
  void save(const std::filesystem::path& path);
  void load(const std::filesystem::path& path);

  [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> faces();

  // On the CPU backend; nothing on the GPU.
  [[nodiscard]] std::optional<SharedParticles> memory();

 private:
  class Turn;

  void start(const std::optional<std::uint32_t>& seed);
  // `name`: of the call, for messages.
  void sendCollider(const std::string& name, const ColliderMove& move, std::optional<double> seconds);
  void restArrivedColliders();
  // What follows is called within a turn.
  void advance(std::int64_t steps, const std::function<void()>& poll);
  void stepSoundly(std::int64_t steps, const std::function<void()>& poll);
  [[nodiscard]] State readState();
  // `source`: what it comes from, for remarks.
  void takeState(const State& state, const std::string& source);
  [[nodiscard]] int frameNow() const;
  [[nodiscard]] int wholeFrames() const;  // that have passed
  void stayInPlace();
  void chooseBackend();
  [[nodiscard]] bool takeContext();  // false where another thread has it
  void needContext();
  [[nodiscard]] bool isContextHere() const;
  void measureNow();

  std::shared_ptr<gl::HeadlessContext> context_;  // outlives what lies on it
  std::thread::id contextThread_;                 // where there is one
  Shared<Scene> scene_;                           // at the start
  std::string backend_;
  std::size_t particles_ = 0, triangles_ = 0;
  double jitter_;
  std::uint32_t seed_;
  std::vector<std::string> remarks_;  // of the scene
  std::string remarkOfState_;         // "" for none
  std::shared_ptr<Simulation> simulation_;
  std::shared_ptr<const void> lookers_;  // keeps the simulation for those who look at its memory
  const float *positionsPlace_ = nullptr, *velocitiesPlace_ = nullptr;
  std::shared_ptr<const std::vector<Particle4>> forces_;
  ColliderWays ways_;
  std::unique_ptr<SimulationRenderer> renderer_;
  RunSummary summary_;
  std::atomic_flag isBusy_;
  int stepsAtOnce_ = 1;
  std::int64_t stepsSinceKept_ = 0;  // since the state that a divergence goes back to; 0: it is to be kept
};

}  // namespace clothsim
