// The CPU backend: the same passes as the GPU's, over rows, with OpenMP. CpuSolver<float> is the bitwise twin
// of the GPU solver; CpuSolver<double> checks the physics.
#pragma once

#include <optional>
#include <vector>

#include "solver/cpu/cpu_state.h"
#include "solver/cpu/implicit_step.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/self_collision.h"
#include "solver/solver.h"
#include "solver/step_params.h"

namespace clothsim {

template <class Real>
class CpuSolver final : public Solver {
 public:
  // `cloth` must outlive the solver. With `fused` a row goes through forces, integration and colliders before
  // the next one; the bits are the same either way.
  CpuSolver(const Cloth& cloth, const Scene& scene, bool fused = true);

  void configure(const Scene& scene) override;
  void step(int count) override;
  void finish() override {}
  [[nodiscard]] std::optional<Trouble> trouble() override;
  [[nodiscard]] std::unique_ptr<Snapshot> snapshot(std::unique_ptr<Snapshot> reuse) override;
  void restore(const Snapshot& snapshot) override;
  [[nodiscard]] State state() override;
  void setState(const State& state) override;
  void convertVelocities() override;
  [[nodiscard]] std::vector<Particle4> positions(std::uint32_t first, std::uint32_t count) override;
  void setHand(const Hand& hand) override { hand_ = hand; }
  void setCuts(const Cuts& cuts) override;
  [[nodiscard]] const Cuts& cuts() const override { return cuts_; }
  void setPin(std::uint32_t particle, bool pinned) override;
  [[nodiscard]] const StepClock& clock() const override { return clock_; }
  [[nodiscard]] ContactCounts contactCounts() override { return selfCollision_.counts(); }
  [[nodiscard]] std::string backend() const override { return "cpu"; }
  [[nodiscard]] std::string device() const override;

  // The state in full precision, for tests; velocities of the half step before under `verlet`.
  [[nodiscard]] Vec3<Real> position(std::uint32_t particle) const;
  [[nodiscard]] Vec3<Real> velocity(std::uint32_t particle) const;
  void setPosition(std::uint32_t particle, Vec3<Real> position);
  void setVelocity(std::uint32_t particle, Vec3<Real> velocity);
  // Force of springs and air on a particle, without gravity, in the current state [N].
  [[nodiscard]] std::vector<Vec3<Real>> forces();

 private:
  [[nodiscard]] StepParams<Real> paramsOf(std::size_t grid) const;  // of the next step
  [[nodiscard]] cpu::PassArguments<Real> arguments(const StepParams<Real>& params);
  void preparePins();
  void prepareMotions();
  void forgetSupport();
  void forgetTrouble();
  void checkStart();
  void stepOnce();
  template <class Pass>
  void forEachRow(const Grid& grid, int rows, Pass pass);

  const Cloth* cloth_;
  Scene scene_;
  bool fused_;
  bool parallel_;  // worth waking the threads for
  Integrator velocityMeaning_ = Integrator::verlet;
  StepClock clock_;
  CpuState<Real> before_, after_;
  bool startChecked_ = true;  // false once a state was handed in
  WatchRow watch_ = soundWatchRow();
  std::optional<Trouble> trouble_;
  Components<Real> forces_;
  std::vector<Real> support_;  // all 0 unless
  bool hasSupport_ = false;
  std::vector<Real> inverseMasses_, restLengths_;
  MeshLists<Real> lists_;
  std::vector<ColliderParams<Real>> colliders_;  // of this step,
  ColliderSet colliderSet_;
  PinPaths pinPaths_;
  std::vector<std::uint32_t> offPath_;
  Hand hand_;
  HandParams<Real> handParams_{};  // of this step
  Cuts cuts_;
  std::vector<std::uint32_t> cutMasks_;
  std::vector<PinMotionParams<Real>> pinMotions_;
  Components<Real> pinStarts_;
  std::vector<StepParams<Real>> params_;                 // by grid
  std::vector<std::vector<LimitColor>> limitColors_;     // by grid
  std::optional<cpu::ImplicitStep<Real>> implicitStep_;  // once it was needed
  cpu::SelfCollision<Real> selfCollision_;
};

extern template class CpuSolver<float>;
extern template class CpuSolver<double>;

}  // namespace clothsim
