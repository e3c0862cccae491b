// What both backends need for a step besides the state, evaluated on the host in double and rounded once:
// constants made of parameters, and everything that depends on time (gusts, moving colliders; moving pins are
// in pin_paths.h).
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cloth.h"
#include "core/exact_math.h"
#include "scene/colliders/collider_set.h"
#include "scene/scene.h"
#include "shared/step_params.h"

namespace clothsim {

template <class Real>
using StepParams = shared::StepParams<Real>;
template <class Real>
using SpringParams = shared::SpringParams<Real>;
using LimitColor = shared::LimitColor;

// For one grid and the step that begins at `time` [s].
template <class Real>
[[nodiscard]] StepParams<Real> makeStepParams(const Scene& scene, const Cloth& cloth, std::size_t piece,
                                              double time);

// Which of the forces on single particles act: one bit a FORCE_... of shared/forces.h.
[[nodiscard]] std::uint32_t particleForcesOf(const Scene& scene);

// Whether anything above changes from step to step.
[[nodiscard]] bool dependsOnTime(const Scene& scene);

// Wind plus gust at time t [m/s]. The gust blows along the wind (along +x when there is none): a sum of sines
// whose phases come from the seed, around the given frequency, of standard deviation `strength`.
[[nodiscard]] Vec3d airVelocity(const Wind& wind, double t);

// Whether passes of their own keep the strain limit; in `implicit` a second, stiff spring does.
[[nodiscard]] inline bool limitsInPasses(const Scene& scene) {
  return scene.solver.strainLimit && !isImplicit(scene.solver.integrator);
}

// How often strain limit and colliders take turns in a step. The limiter can pull particles into a collider
// again, and through one that has gone far in the step: with a travelling collider the two go three rounds,
// and the collider has the last word. With resting ones once is enough, in the order of CS184.
[[nodiscard]] int contactRounds(const Scene& scene);

// What the velocities of a cloth at rest mean at the start: CS184 begins `verlet` with v(-1/2) = 0; elsewhere
// v(0) = 0, and the first step converts (v(-1/2) = -h a / 2 makes Verlet second order).
[[nodiscard]] Integrator startingVelocityMeaning(const Scene& scene);

// What the velocities mean that an integrator carries: v(n - 1/2) for `verlet`, v(n) for the others.
[[nodiscard]] inline Integrator velocityMeaningOf(Integrator integrator) {
  return integrator == Integrator::verlet ? Integrator::verlet : Integrator::euler;
}

// The time t in v + t a that turns the other integrator's velocities into those of the scene's: -h/2 for
// `verlet`.
template <class Real>
[[nodiscard]] Real velocityConversionTime(const Scene& scene) {
  const double half = 0.5 * stepLength(scene.solver);
  return static_cast<Real>(scene.solver.integrator == Integrator::verlet ? -half : half);
}

// Where a particle starts, as the backends store it [m].
template <class Real>
[[nodiscard]] Vec3<Real> startPosition(const Cloth& cloth, std::size_t particle) {
  const Vec3<Real> x = cloth.positions()[particle].cast<Real>();
  return {canonical(x.x), canonical(x.y), canonical(x.z)};
}

// Rest lengths measured between start positions by the step's own arithmetic, so that a cloth at rest feels
// no force at all. Slot-major (slot * particles + owner); empty when no grid needs the table [m].
template <class Real>
[[nodiscard]] std::vector<Real> measureRestLengths(const Cloth& cloth);

// The strain limit's order: slots ascending, two colours each, only enabled ones; of a mesh its colours. Both
// backends go through it alike.
[[nodiscard]] std::vector<LimitColor> makeLimitColors(const Piece& piece);
// Owners of a colour in each direction.
[[nodiscard]] std::uint32_t ownerCount(std::uint32_t first, std::uint32_t step, std::uint32_t run,
                                       std::uint32_t end);

}  // namespace clothsim
