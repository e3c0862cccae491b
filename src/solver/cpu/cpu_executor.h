// Executes passes on the CPU, with all threads: row by row, several passes in one go where they allow it
// (row_passes.h). CpuExecutor<float> is the bitwise twin of the GPU's, CpuExecutor<double> checks the
// physics.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/cpu/cpu_state.h"
#include "solver/cpu/implicit_passes.h"
#include "solver/cpu/mesh_stretches.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/row_passes.h"
#include "solver/cpu/self_collision.h"
#include "solver/cpu/surface_contact.h"
#include "solver/executor.h"

namespace clothsim {

template <class Real>
class CpuExecutor final : public Executor {
 public:
  // `cloth` must outlive it. With `sweeps` passes go down the rows together where they can; the bits are the
  // same either way.
  CpuExecutor(const Cloth& cloth, bool sweeps);

  void prepare(const StepInputs& inputs, const PassList& list) override;
  void setScene(const StepInputs& inputs) override;
  void setCuts(const StepInputs& inputs) override;
  void run(const StepInputs& inputs, const PassList& list, int steps) override;
  void flush() override {}
  void finish() override {}
  void upload(const State& state) override;
  void download(State& state) override;
  [[nodiscard]] std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) override;
  void setInverseMass(std::uint32_t particle, double inverseMass, bool rests) override;
  [[nodiscard]] std::unique_ptr<ParticleCopy> copy(std::unique_ptr<ParticleCopy> reuse) override;
  [[nodiscard]] bool restore(const ParticleCopy& copy) override;
  void forgetHistory() override;
  [[nodiscard]] std::optional<Divergence> findDivergence(std::uint64_t step, bool wait) override;
  void forgetDivergence(std::uint64_t step) override;
  [[nodiscard]] ContactCounts contactCounts() override {
    return selfCollision_.counts() + surfaceContact_.counts();
  }
  [[nodiscard]] ConvergenceCounts convergenceCounts() override;
  void forgetContactCounts() override {
    selfCollision_.forgetCounts();
    surfaceContact_.forgetCounts();
  }
  void startTiming() override;
  [[nodiscard]] std::vector<PassTime> stopTiming() override;
  [[nodiscard]] std::string backend() const override { return "cpu"; }
  [[nodiscard]] std::string device() const override;

  // The state in full precision, for tests.
  [[nodiscard]] CpuState<Real>& state() { return particles_.state; }
  [[nodiscard]] const Components<Real>& forces() const { return forces_; }

  [[nodiscard]] const std::vector<Real>& inverseMasses() const { return particles_.inverseMasses; }
  void returnTo(const Real* positions, const Real* velocities);  // as CpuSolver's

 private:
  struct Particles {
    CpuState<Real> state;
    std::vector<Real> inverseMasses;
  };
  struct Copy;

  [[nodiscard]] cpu::PassArguments<Real> argumentsOf(const StepInputs& inputs, std::size_t piece);
  void runSweep(std::span<const PassCall> passes);
  void runContacts(PassCall call);
  void setSurface(const StepInputs& inputs);
  void setHistory(const State& state);
  void makeImplicitLists(const Cuts& cuts);
  void sum(Pass pass);
  void chooseLength();
  void tryShorterLengths();
  void refuseExactHessian();
  void measureUpdate();
  [[nodiscard]] bool isSkipped(Gate gate) const;
  void adopt(Outcome outcome);

  const Cloth* cloth_;
  bool sweeps_;
  Particles particles_;
  CpuState<Real> after_;  // at the end of the step
  Components<Real> forces_;
  WatchRow watch_ = soundWatchRow();
  std::vector<Real> restLengths_;
  MeshLists<Real> lists_;
  cpu::MeshStretches<Real> stretches_;
  std::shared_ptr<const std::vector<float>> distances_;  // samples of the mesh colliders' grids
  Components<Real> pinStarts_;                           // empty without paths
  StepParameters<Real> parameters_;                      // of this step,
  std::vector<cpu::ImplicitArguments<Real>> pieces_;     // and what passes get, by grid
  cpu::ImplicitState<Real> implicit_;                    // empty until an implicit step needs it
  std::vector<Real> partialSums_;
  cpu::RowPasses<Real> rowPasses_;
  cpu::SelfCollision<Real> selfCollision_;
  cpu::SurfaceContact<Real> surfaceContact_;
  bool hasSurface_ = false;  // otherwise friction remembers no pairs
  bool isTimed_ = false;
  std::vector<PassTime> times_;
};

extern template class CpuExecutor<float>;
extern template class CpuExecutor<double>;

}  // namespace clothsim
