// Pass 4 on the CPU: particles out of colliders; the twin of shaders/sim/collide.glsl.
#pragma once

#include "solver/cpu/passes.h"

namespace clothsim::cpu {

// One row of the grid, in place on `after`: particles that are inside a collider, or went through it on the
// way from `before.positions` (carried along with a moving collider), go to its surface as the friction law
// says; each move dx adds dx / h to the velocity. May run more than once in a step, after any pass that moves
// particles. At the end no particle is inside the collider that was handled last.
void collide(const PassArguments<float>& arguments, int row);
void collide(const PassArguments<double>& arguments, int row);

}  // namespace clothsim::cpu
