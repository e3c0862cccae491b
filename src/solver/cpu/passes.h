// The passes of a step on the CPU, each over a stretch of one grid row or over one colour of springs. They
// are the twins of shaders/sim/*.glsl: same names, same order of operations. Real is float for the bitwise
// twin, double for the physics tests.
#pragma once

#include <cstdint>

#include "cloth/cloth.h"
#include "solver/cpu/cpu_state.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

// Everything a pass reads and writes; `before` is the state at the start of the step, `after` the one at its
// end.
template <class Real>
struct PassArguments {
  const StepParams<Real>& step;
  const ColliderParams<Real>* colliders;  // those of this step
  const Real* inverseMasses;
  const Real* restLengths;  // slot-major; null when no grid needs the table
  const CpuState<Real>& before;
  CpuState<Real>& after;
  Components<Real>& forces;  // springs, wind and air, without gravity [N]
};

// One row of the grid.
void gatherForces(const PassArguments<float>& arguments, int row);
void gatherForces(const PassArguments<double>& arguments, int row);
void integrate(const PassArguments<float>& arguments, int row);
void integrate(const PassArguments<double>& arguments, int row);
void collide(const PassArguments<float>& arguments, int row);
void collide(const PassArguments<double>& arguments, int row);
// after.velocities = before.velocities + kickTime * acceleration, positions untouched.
template <class Real>
void kick(const PassArguments<Real>& arguments, int row);

// Row j of the colour's owners; works in place on `after`.
template <class Real>
void limitStrain(const PassArguments<Real>& arguments, const LimitColor& color, std::uint32_t j);

}  // namespace clothsim::cpu
