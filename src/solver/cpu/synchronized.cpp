#include "solver/cpu/synchronized.h"

#include "solver/cpu/cpu_solver.h"

namespace clothsim {

State synchronized(const Cloth& cloth, const Scene& scene, const State& state) {
  if (state.integrator == Integrator::euler) return state;
  Scene asEuler = scene;
  asEuler.solver.integrator = Integrator::euler;
  CpuSolver<float> solver(cloth, asEuler);
  solver.setState(state);
  return solver.state();
}

}  // namespace clothsim
