// Air on the triangles of a grid; the twin of shaders/sim/air.glsl. A function of its own: in one with the
// springs, the compiler takes longer for both.
#pragma once

#include <algorithm>

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_rows.h"
#include "solver/cpu/passes.h"

namespace clothsim::cpu {

// The forces of a row, counted from the first particle of these.
template <class Real>
INLINE Arrays<Real> forcesOf(const PassArguments<Real>& arguments, Range particles) {
  return countedFrom(particles.begin, arraysOf(arguments.forces));
}
template <class Real>
INLINE void clearForces(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  for (Component<Real>* f : {&arguments.forces.x, &arguments.forces.y, &arguments.forces.z})
    std::fill(f->data() + particles.begin, f->data() + particles.end, Real(0));
}

// Adds the wind to the forces of a row.
void addWind(const PassArguments<float>& arguments, int row, ForceRows<float>& rows);
void addWind(const PassArguments<double>& arguments, int row, ForceRows<double>& rows);

}  // namespace clothsim::cpu
