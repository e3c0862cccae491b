#include "solver/cpu/cpu_solver.h"

#include "solver/cpu/arrays.h"

namespace clothsim {

template <class Real>
Vec3<Real> CpuSolver<Real>::position(std::uint32_t particle) const {
  return cpu::at(own().state().positions, particle);
}
template <class Real>
Vec3<Real> CpuSolver<Real>::velocity(std::uint32_t particle) const {
  return cpu::at(own().state().velocities, particle);
}
template <class Real>
void CpuSolver<Real>::setPosition(std::uint32_t particle, Vec3<Real> position) {
  cpu::put(own().state().positions, particle, position);
  distrustState();
}
template <class Real>
void CpuSolver<Real>::setVelocity(std::uint32_t particle, Vec3<Real> velocity) {
  cpu::put(own().state().velocities, particle, velocity);
  distrustState();
}

template <class Real>
std::vector<Vec3<Real>> CpuSolver<Real>::forces() {
  own().run(inputs(), listOf({Pass::forces}, Outcome::nothing), 1);
  std::vector<Vec3<Real>> result(inputs().cloth->particleCount());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = cpu::at(own().forces(), static_cast<std::ptrdiff_t>(i));
  return result;
}

template class CpuSolver<float>;
template class CpuSolver<double>;

}  // namespace clothsim
