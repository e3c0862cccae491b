// Springs, hinges and membranes of meshes in an implicit step, gathered over lists; the twin of
// shaders/sim/implicit/mesh.glsl.
#pragma once

#include "solver/cpu/implicit_passes.h"

namespace clothsim::cpu {

// Adds them to the diagonal blocks in `factors`; to `products`, as forces; to `trials`.
template <class Real>
void addMeshBlocks(const ImplicitArguments<Real>& arguments, int row);
template <class Real>
void addMeshProducts(const ImplicitArguments<Real>& arguments, int row);
template <class Real>
void addMeshTrials(const ImplicitArguments<Real>& arguments, int row);

}  // namespace clothsim::cpu
