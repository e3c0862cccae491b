// A scene being simulated: the scene, its cloth, and a solver on the chosen backend. It needs no OpenGL. A
// program with OpenGL passes makeSolver() of simulation/gpu/solvers.h, which knows the GPU backend.
//
// The library cloth_core does all that `clothsim run` does without pictures: loadSceneByName() and
// readScene() in scene_io/ load a scene, Simulation steps it, RunSummary in run_summary.h measures it, and
// SavedFiles in saved_files.h and saveState() in export/ save it.
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

// Makes a solver on the backend of that name. @throws UsageError for an unknown name, OpenGlError
using SolverFactory = std::unique_ptr<Solver> (*)(const std::string& backend, const Shared<Cloth>& cloth,
                                                  const Shared<Scene>& scene);
// The factory of programs without OpenGL: it knows "cpu" only.
[[nodiscard]] std::unique_ptr<Solver> makeCpuSolver(const std::string& backend, const Shared<Cloth>& cloth,
                                                    const Shared<Scene>& scene);

class Simulation {
 public:
  // A simulation at the start of the scene. @throws SceneError, UsageError, OpenGlError
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
  // Summed over all solvers that this simulation has had.
  [[nodiscard]] ContactCounts contactCounts() { return contactsBefore_ + solver_->contactCounts(); }
  void forgetContactCounts() {  // they begin anew, for a run that does
    contactsBefore_ = {};
    solver_->forgetContactCounts();
  }
  // The same. The last update is 0 while the integrator is an explicit one.
  [[nodiscard]] ConvergenceCounts convergenceCounts();

  void stepFrame() { stepFrames(1); }
  void stepFrames(int frames);
  // The divergence in the steps since the last stepFrame(), stepFrames() or keep(), if any. The state is then
  // the sound one from before that call, so that nothing broken can be drawn or saved. @throws
  // Interrupted when an interrupt cut the frames short
  [[nodiscard]] std::optional<Divergence> checkFrame();
  // The same in parts: remembers the state for checkFrame() to go back to, and makes single steps.
  void keep() { solver_->keep(); }
  void step(int steps) { solver_->step(steps); }
  // Waits for the GPU until every step is done.
  void finish() { solver_->finish(); }

  // A copy of the state; waits for the GPU. setState() also takes one of another simulation of the same
  // cloth.
  [[nodiscard]] State state() { return solver_->state(); }
  void setState(const State& state);
  // Back to the start of the scene.
  void restart();

  // Takes live edits: everything but the lattice and the springs of the cloths (needsRebuild() in
  // session/carry_over.h).
  void configure(const Shared<Scene>& scene);
  // Takes any edit: makes a new cloth and a new solver and restarts. After an exception nothing has changed.
  // @throws as the constructor
  void rebuild(const Shared<Scene>& scene);
  // Continues from the same bits on another backend. After an exception nothing has changed. @throws as
  // makeSolver
  void switchBackend(const std::string& backend);

  // To be called after the state was changed through solver().
  void touch() { ++version_; }
  // Changes whenever the state changes other than by steps. Copies made before are out of date then.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  void replaceSolver(std::unique_ptr<Solver> solver);

  Shared<Scene> scene_;
  Shared<Cloth> cloth_;
  SolverFactory makeSolver_;
  std::unique_ptr<Solver> solver_;
  ContactCounts contactsBefore_;
  ConvergenceCounts convergenceBefore_;
  std::uint64_t version_ = 0;
};

// The message "the simulation blew up: in step ..." with advice.
[[nodiscard]] std::string blowUpText(const Divergence& divergence, const Cloth& cloth, const Scene& scene,
                                     std::optional<int> frame = std::nullopt);

}  // namespace clothsim
