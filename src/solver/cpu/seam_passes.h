// The springs of seams, gathered over lists; the twin of shaders/sim/seams.glsl, seam_forces.glsl and
// implicit/seams.glsl. The coarse levels of the preconditioner know that they hold a particle, not what else
// they join.
#pragma once

#include "solver/cpu/implicit_passes.h"

namespace clothsim::cpu {

// Whether there are any.
template <class Real>
[[nodiscard]] bool hasSeams(const PassArguments<Real>& arguments) {
  return !arguments.lists.seamStarts.empty();
}
// Adds those of a row to the forces; to the diagonal blocks in `factors`; to `products`, as forces; to
// `trials`.
template <class Real>
void addSeamForces(const PassArguments<Real>& arguments, int row);
template <class Real>
void addSeamBlocks(const ImplicitArguments<Real>& arguments, int row);
template <class Real>
void addSeamProducts(const ImplicitArguments<Real>& arguments, int row);
template <class Real>
void addSeamTrials(const ImplicitArguments<Real>& arguments, int row);

}  // namespace clothsim::cpu
