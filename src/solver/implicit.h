// The implicit integrator (solver.integrator: "implicit"), what both backends share. Backward Euler: over a
// step of h, the displacement d of all particles is the minimum of
//
//   sum of m/2 (1 + c h)/h^2 |d - inertial guess|^2  +  elastic energy at x + d  +  energy of air and grabs,
//   inertial guess = h (v + h g)/(1 + c h),
//
// and v' = d / h. The velocity comes from d itself, never from a difference of positions, which would round.
//
// The search starts from h (v + (1 - support) h g)/(1 + c h). A particle's support, 0 to 1, is the part of
// its weight that held it up in the step before, so that what falls freely and what hangs at rest begin where
// they belong. Support is part of the state. The start is shortened (1, 1/2, 1/4, 1/8) until the energy
// falls: for a stiff rotating sheet it lies too far away for a few Newton steps.
//
// Colliders take part. Before each Newton step, a particle inside a collider gets the plane in which it
// touches it as a stiff spring, so that the sheet bends around what it lies on. Friction acts by the depth to
// which that spring has pushed the particle out. Particles end a hair inside; the collision pass after the
// step moves them to the surface.
//
// A Newton step: the Hessian is made positive by clamping the springs' transverse part to k max(0, 1 - L/l)
// (Choi and Ko 2002). It is solved by conjugate gradients with an additive multilevel preconditioner
// (Bramble, Pasciak and Xu 1990, "BPX"):
//
//   z = sum over levels of P_l D_l^-1 P_l^T r,
//
// P_l is bilinear interpolation from a lattice of every 2^l-th grid point, down to 2 x 2; it does not cross
// cuts. D_l are blocks of 3 x 3. Pinned particles are no unknowns. All sums run over a fixed tree, and
// scalars stay on the device: there is no read-back in a step.
//
// Coarse blocks approximate the diagonal of P_l^T H P_l. Two symmetric matrices a vertex are summed up from
// level to level by P^T: S, half the sum of e^2 K over a particle's springs (K the spring's Hessian, e its
// length in cells), and T, inertia and air plus K of springs to pinned particles. With hat functions of H
// cells width on a lattice, the integral of their squared slopes and that of their squares make
//
//   D = g S + f T,  g = (2 Hy^2 + 1) / (3 Hx^2 Hy^2) + (the same, x and y exchanged),
//   f = product of (2 H^2 + 1)/(3 H^2) over x and y.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "shared/implicit.h"

namespace clothsim {

template <class Real>
using LevelParams = shared::LevelParams<Real>;
template <class Real>
using ImplicitScalars = shared::ImplicitScalars<Real>;

template <class Real>
struct Hierarchy {
  std::vector<std::vector<LevelParams<Real>>> pieces;  // by grid, finest first
  std::uint32_t vertices = 0;                          // of all levels; the particles come first
};

template <class Real>
[[nodiscard]] Hierarchy<Real> makeHierarchy(const Cloth& cloth);

// The fine point that a coarse one is, along one direction: every second one, and the last.
template <class Index>
[[nodiscard]] constexpr Index finePoint(Index coarse, Index coarseCount, Index fineCount) {
  if (coarseCount == fineCount) return coarse;
  return coarse + 1 == coarseCount ? fineCount - 1 : 2 * coarse;
}

// Cuts as the levels see them, so that nothing is interpolated across: a number a vertex, whose LINK_BITs say
// from which neighbours on its level it is cut off. Coarse neighbours are cut off from each other when a link
// between them on the next finer level is, on the way there (diagonally first) or back. `cutMasks` as
// makeCutMasks() gives them; empty for none.
template <class Real>
[[nodiscard]] std::vector<std::uint32_t> makeCutLinks(const Cloth& cloth,
                                                      const std::vector<std::uint32_t>& cutMasks,
                                                      const Hierarchy<Real>& hierarchy);

// For a grid without a coarser level, and a mesh: itself as the coarsest one.
template <class Real>
[[nodiscard]] LevelParams<Real> onlyLevel(const Piece& piece) {
  LevelParams<Real> level{};
  level.coarseFirst = piece.firstParticle;
  level.coarseColumns = static_cast<std::uint32_t>(piece.columns);
  level.coarseRows = static_cast<std::uint32_t>(piece.rows);
  return level;
}

}  // namespace clothsim
