// Colliders that are small against the cells of the cloth act on its triangles (solver/surface.h): the twin
// of shaders/sim/surface/{near,meet,press}.*.
//
// A triangle that comes near such a collider is a pair of the implicit step. In each Newton step the place of
// the triangle is sought that meets the collider, and what it meets is what a particle would meet there.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/cpu/implicit_passes.h"
#include "solver/surface.h"

namespace clothsim::cpu {

// The pairs of a triangle with the colliders that are near its way in the step.
template <class Real>
void addNearColliders(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
                      const ImplicitState<Real>& implicit, const SurfaceTriangle& triangle,
                      std::vector<SurfacePair<Real>>& found);

// What these pairs are at the iterate.
template <class Real>
void meetColliders(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
                   ImplicitState<Real>& implicit);

// A round at the end of a step. In the first one what the solution leaves of Coulomb's friction stops slips,
// or shortens them. In the next ones what is still deep in a small collider is pushed out, whatever it costs.
// In the last one, PRESS_ROUNDS, nothing moves, and the triangles are counted that cores have passed.
template <class Real>
void pressOut(const ClothSurface<Real>& surface, const PassArguments<Real>& arguments,
              ImplicitState<Real>& implicit, SurfaceState& state, std::uint32_t round);

}  // namespace clothsim::cpu
