// Forces on the particles of meshes, gathered over lists; the twin of shaders/sim/mesh.glsl.
#pragma once

#include "solver/cpu/passes.h"

namespace clothsim::cpu {

// Springs, bending and wind on a stretch of a mesh, over the zeros that are there.
void gatherMeshForces(const PassArguments<float>& arguments, int row);
void gatherMeshForces(const PassArguments<double>& arguments, int row);

// The wind alone, and the matrices by which it resists velocities [N s/m].
template <class Real>
void gatherMeshWind(const PassArguments<Real>& arguments, int row, SymmetricField<Real>& resistance);

}  // namespace clothsim::cpu
