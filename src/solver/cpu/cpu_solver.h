// A solver on the CPU.
#pragma once

#include <vector>

#include "solver/cpu/cpu_executor.h"
#include "solver/solver.h"

namespace clothsim {

template <class Real>
class CpuSolver final : public Solver {
 public:
  // `cloth` must outlive the solver. `sweeps`: see CpuExecutor.
  CpuSolver(const Cloth& cloth, const Shared<Scene>& scene, bool sweeps = true)
      : Solver(cloth, scene, std::make_unique<CpuExecutor<Real>>(cloth, sweeps)) {}

  // The state in full precision, for tests; velocities of the half step before under `verlet`.
  [[nodiscard]] Vec3<Real> position(std::uint32_t particle) const;
  [[nodiscard]] Vec3<Real> velocity(std::uint32_t particle) const;
  void setPosition(std::uint32_t particle, Vec3<Real> position);
  void setVelocity(std::uint32_t particle, Vec3<Real> velocity);
  // The particles where they lie in memory. A step may leave them at another place of two or three.
  [[nodiscard]] const CpuState<Real>& particles() const { return own().state(); }
  [[nodiscard]] const std::vector<Real>& inverseMasses() const { return own().inverseMasses(); }
  // Takes them back to places where they have lain before, by a copy unless they lie there.
  void returnTo(const Real* positions, const Real* velocities) { own().returnTo(positions, velocities); }
  // Force of springs and air on a particle, without gravity, in the current state [N].
  [[nodiscard]] std::vector<Vec3<Real>> forces();

 private:
  [[nodiscard]] CpuExecutor<Real>& own() const { return static_cast<CpuExecutor<Real>&>(executor()); }
};

extern template class CpuSolver<float>;
extern template class CpuSolver<double>;

}  // namespace clothsim
