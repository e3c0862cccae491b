// Runs the passes over the levels of the implicit integrator's preconditioner (solver/hierarchy.h).
#pragma once

#include <span>

#include "solver/cpu/implicit_passes.h"
#include "solver/step_list.h"

namespace clothsim::cpu {

// A pass whose domain is coarse vertices, blocks or fine vertices, for all pieces.
template <class Real>
void runOnLevel(PassCall call, std::span<const ImplicitArguments<Real>> pieces, ImplicitState<Real>& own,
                const Real* inverseMasses);

}  // namespace clothsim::cpu
