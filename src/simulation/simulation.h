// A scene being simulated: its cloth, the solver on the chosen backend, and the clock in frames. Needs no
// OpenGL: a program that has it brings the GPU's solver from simulation/gpu/solvers.h.
//
// All that `clothsim run` does without pictures is in this library: loadSceneByName() or readScene() load a
// scene (scene_io/), a Simulation steps it, RunSummary measures it (run_summary.h), SavedFiles and
// saveState() export it (saved_files.h, export/).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "scene/scene.h"
#include "solver/solver.h"

namespace clothsim {

// Makes the solver of a backend by its name. @throws UsageError for a name that it does not know, OpenGlError
using SolverFactory = std::unique_ptr<Solver> (*)(const std::string& backend, const Shared<Cloth>& cloth,
                                                  const Shared<Scene>& scene);
// Knows "cpu" alone.
[[nodiscard]] std::unique_ptr<Solver> makeCpuSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                                    const Shared<Scene>& scene);

class Simulation {
 public:
  // At the start of the scene. @throws SceneError, UsageError, OpenGlError
  explicit Simulation(const Shared<Scene>& scene, const std::string& backend = "cpu",
                      SolverFactory makeSolver = makeCpuSolver);

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const Shared<Scene>& sharedScene() const { return scene_; }
  [[nodiscard]] const Cloth& cloth() const { return *cloth_; }
  [[nodiscard]] const Shared<Cloth>& sharedCloth() const { return cloth_; }
  [[nodiscard]] Solver& solver() { return *solver_; }
  [[nodiscard]] const Solver& solver() const { return *solver_; }
  [[nodiscard]] SolverFactory solverFactory() const { return makeSolver_; }
  [[nodiscard]] double time() const { return solver_->clock().time(); }  // simulated [s]
  // Of all solvers that it has had.
  [[nodiscard]] ContactCounts contactCounts() { return contactsBefore_ + solver_->contactCounts(); }

  void stepFrame() { stepFrames(1); }
  void stepFrames(int frames);
  // Looks for trouble in the last stepFrame() or stepFrames(). After trouble the state is the one before that
  // call, the last one known to be sound: what came after it is gone, and cannot be drawn or saved.
  // @throws SimulationError when an interrupt cut the frames short
  [[nodiscard]] std::optional<Trouble> checkFrame();
  // Waits until every step is done.
  void finish() { solver_->finish(); }

  // A copy of the state, waited for; and going on from one, also of another simulation of the same cloth.
  [[nodiscard]] State state() { return solver_->state(); }
  void setState(const State& state);
  // Back to the start of the scene.
  void restart();

  // Live edits: everything but the cloths' grids.
  void configure(const Shared<Scene>& scene);
  // Any edit: makes a new cloth and solver and begins at the start. What was there stays when it throws.
  // @throws as the constructor
  void rebuild(const Shared<Scene>& scene);
  // Goes on from the same state, to the bit. @throws as makeSolver, leaving the old solver in place
  void switchBackend(const std::string& backend);

  // After a change of the solver's state from outside.
  void touch() { ++version_; }
  // Another one whenever the state is another one by anything but steps: what was made of it is out of date.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  Shared<Scene> scene_;
  Shared<Cloth> cloth_;
  SolverFactory makeSolver_;
  std::unique_ptr<Solver> solver_;
  ContactCounts contactsBefore_;
  std::uint64_t version_ = 0;
};

// "the simulation blew up: in step ... . What to do."
[[nodiscard]] std::string blowUpText(const Trouble& trouble, const Cloth& cloth, const Scene& scene);

}  // namespace clothsim
