// A scene being simulated: its cloth, the solver on the chosen backend, and the clock in frames.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cloth/cloth.h"
#include "gl/buffer.h"
#include "scene/scene.h"
#include "solver/solver.h"

namespace clothsim {

// "gpu" or "cpu"; the GPU needs a current OpenGL context. @throws UsageError for another name, OpenGlError
[[nodiscard]] std::unique_ptr<Solver> makeSolver(const std::string& backend, const Cloth& cloth,
                                                 const Scene& scene);

class Simulation {
 public:
  // @throws SceneError, UsageError, OpenGlError
  Simulation(const Scene& scene, const std::string& backend);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Cloth& cloth() const { return *cloth_; }
  [[nodiscard]] Solver& solver() { return *solver_; }
  [[nodiscard]] const Solver& solver() const { return *solver_; }
  [[nodiscard]] double time() const { return solver_->clock().time(); }  // simulated [s]
  // Of all solvers that it has had.
  [[nodiscard]] ContactCounts contactCounts() { return contactsBefore_ + solver_->contactCounts(); }

  void stepFrame() { stepFrames(1); }
  void stepFrames(int frames) {
    solver_->keep();
    solver_->step(frames * scene_.solver.simulationSteps);
  }
  // Looks for trouble in the last stepFrame() or stepFrames(). After trouble the state is the one before that
  // call, the last one known to be sound: what came after it is gone, and cannot be drawn or saved.
  // @throws SimulationError when an interrupt cut the frames short
  [[nodiscard]] std::optional<Trouble> checkFrame();
  void finish() { solver_->finish(); }
  void restart();
  // Live edits: everything but the cloths' grids.
  void configure(const Scene& scene);
  // Any edit: makes a new cloth and solver and begins at the start. What was there stays when it throws.
  // @throws as the constructor
  void rebuild(const Scene& scene);
  // After a change of the solver's state from outside: what was uploaded to draw from is out of date.
  void touch() { uploadIsCurrent_ = false; }
  // Goes on from the same state, to the bit. @throws as makeSolver, leaving the old solver in place
  void switchBackend(const std::string& backend);

  // A vec4 a particle to draw from: the GPU solver's own, or the CPU's state uploaded once after each change.
  [[nodiscard]] GLuint positionsBuffer();

 private:
  Scene scene_;
  std::unique_ptr<Cloth> cloth_;  // the solver keeps a pointer to it
  std::unique_ptr<Solver> solver_;
  ContactCounts contactsBefore_;
  gl::Buffer<Particle4> uploaded_;
  bool uploadIsCurrent_ = false;
  std::uint64_t uploadedStep_ = 0;
};

// "the simulation blew up: in step ... . What to do."
[[nodiscard]] std::string blowUpText(const Trouble& trouble, const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
