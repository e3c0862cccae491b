// The implicit integrator (solver.integrator: "implicit"), what both backends share. Backward Euler: over a
// step of h, the displacement d of all particles is the minimum of
//
//   sum of m/2 (1 + c h)/h^2 |d - inertial guess|^2  +  elastic energy at x + d  +  energy of air and grabs,
//   inertial guess = h (v + h g)/(1 + c h),
//
// and v' = d / h. The velocity comes from d itself, never from a difference of positions, which would round.
//
// Under "bdf2", the backward difference of second order, 2 h / 3 stands for h, and a third of the last step's
// change is added to the velocity and to the guess; v' = (d - a third of the last displacement) / (2 h / 3).
// A whole step is backward Euler where the last steps were not usual (USUAL_STEPS).
//
// The search starts from h v. It ends when the last update is at most `tolerance` of the largest
// displacement, or of a tenth of the spacing where that is larger, and otherwise after `newton_steps`: then
// the step counts as unconverged. The linear solver ends when r.z has fallen by tolerance^2, or to what a
// solved step may lack, or after `cg_iterations`; where that is "auto", after five times as many in late
// Newton steps. An update is small, too, where the linear solver has hardly
// begun, or the Hessian was projected: what is still to come has to be small as well
// (CpuExecutor::measureUpdate).
//
// Colliders take part. A particle in a collider gets the plane in which it touches it as a stiff spring, so
// that the sheet bends around what it lies on. At first, so does a particle that inertia and gravity alone
// would take into a collider; the search starts with all of these on their planes. And so does one that is
// nearer to a collider than a solved step may be wrong: what is pulled over an edge, or lies on a slope,
// gravity alone would take away from it. Which planes hold in a Newton step, the force on each particle
// decides, and what no plane holds stops where it would cross its own (solver/cpu/implicit_contact.h). The
// line search counts a plane from one side: what has left it costs nothing. Friction follows Coulomb's law
// with the push of the particle and a potential that is smooth at slow slip (Li et al. 2020, "Incremental
// potential contact"). Friction remembers how far it was stretched when a step ended, its elastic slip
// (Cundall and Strack 1979, "A discrete numerical model for granular assemblies"), and begins with that; in
// the first Newton step, what held then holds. So cloth at rest has nothing to find. What the solution leaves
// of the law stops the rest of the slip at the end. Particles end a hair inside; the collision pass after the
// step moves them to the surface.
//
// A Newton step takes the Hessian projected: the springs' transverse part is clamped to k max(0, 1 - L/l)
// (Choi and Ko 2002). Once an update is small, cloth that touches nothing takes the exact one: where cloth
// has buckled, what compression takes from it is nearly all of it. Where conjugate gradients meet a direction
// along which it is not positive, they end with what they have found so far (Nocedal and Wright, "Numerical
// optimization", 2006, algorithm 7.1), and the rest of the step is projected (HESSIAN_REFUSED). The
// preconditioner is always made of projected blocks, with the tension of the step's start, since straight
// motions stretch what turns; it is additive and multilevel (Bramble, Pasciak and Xu
// 1990):
//
//   z = D^-1 r  +  sum over coarse levels of P_l A_l^-1 P_l^T r.
//
// Coarse vertices are aggregates of particles (solver/hierarchy.h), and each moves as a rigid body: particle
// i follows those that it hangs on with the weights w by
//
//   d_i = sum of w_c (t_c + r_c x (x_i - X_c)),   X_c the weighted mean of the places,
//
// so that what turns as a whole, as the free end of a cantilever does, costs the solver nothing. Residuals
// and corrections of all levels, forces and motions with six numbers each, are kept about the first particle:
// so they add up as they are, and only the matrices are about the X_c. The matrices
// of the levels are P_l^T H P_l (Galerkin): the first one is summed up from springs, bending, inertia and
// contacts, the others from the level before. Of the middle levels the blocks on the diagonal are inverted,
// of the coarsest one the whole matrix. There one unknown is the motion of all as one rigid body, with a row
// that is summed up without the springs, which it does not stretch: sheets as stiff as paper are 10^8 times
// as stiff as their inertia, and sums in binary32 would hold nothing of that. The matrices are made in every
// second step of a frame, beginning with the first, before its first Newton step; in the steps between, only
// the places X_c are new. D are the blocks of 3 x 3 of the particles. Pinned particles are no unknowns. All
// sums run in a fixed order, and scalars stay on the device: no step waits for a read-back. What is solved
// already does nothing, and is not even dispatched where the host knows it.
#pragma once

#include "shared/implicit.h"
#include "solver/executor.h"

namespace clothsim {

template <class Real>
using ImplicitScalars = shared::ImplicitScalars<Real>;

template <class Real>
[[nodiscard]] ConvergenceCounts convergenceOf(const ImplicitScalars<Real>& scalars) {
  return {scalars.steps,
          scalars.unconvergedSteps,
          scalars.allNewtonSteps,
          scalars.allIterations,
          static_cast<double>(scalars.lastUpdate),
          scalars.secondOrderSteps};
}

}  // namespace clothsim
