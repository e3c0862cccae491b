// What a person or another program does to the cloth: a grab pulls particles by a spring, a jet blows air,
// and forces act on single particles. All are plain values. What depends on time is evaluated on the host,
// the same for both backends.
//
// The spring of a grab is critically damped and integrated implicitly, so it is stable at any strength. With
// w = sqrt(strength), u the velocity of the grab and v' the velocity after all forces,
//   v_new = (v' + 2 h w u + h w^2 (goal - x)) / (1 + 2 h w + h^2 w^2),  x_new = x + h v_new.
// v_new is at most 30 m/s, so that a goal far away does not tear the cloth in one step. A particle of weight
// c < 1 takes that part of the change: v' + c (v_new - v'). Pinned particles stay. The pass comes right after
// the integration: strain limit, self-collision and colliders have the last word. In the implicit integrator
// the same spring is part of the energy, with weight c, towards a goal no farther than h 30 m/s.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "shared/interaction.h"
#include "shared/step_params.h"
#include "solver/state.h"

namespace clothsim {

template <class Real>
using InteractionParams = shared::InteractionParams<Real>;

// The spring of a grab, and the block of grid points that it pulls.
struct GrabSpring {
  // Of one grid point: where its goal lies from the grab's place, and its weight, 0 outside the radius. In
  // the layout of the GPU.
  struct alignas(16) Point {
    Vec3f offset;  // [m]
    float weight = 0;
  };

  std::size_t piece = 0;
  std::uint32_t firstColumn = 0, firstRow = 0, columns = 0, rows = 0;
  std::shared_ptr<const std::vector<Point>> points;  // row-major
  double strength = 0;                               // w^2 [1/s^2]

  Vec3d from, to;               // the grab moves from here to there [m],
  std::uint64_t firstStep = 0;  // beginning with this step,
  int steps = 1;                // in so many
};

// Air that blows along an axis: at the distance r from it, speed (1 - (r / radius)^2)^2; rising from 0 at the
// origin to that within one radius along the axis, and resting behind it.
struct Jet {
  Vec3d origin, direction;  // [m]; any length but 0
  double speed = 0;         // [m/s]
  double radius = 0.1;      // [m], > 0
};

struct Interaction {
  std::optional<GrabSpring> grab;
  std::optional<Jet> jet;
  // xyz [N] on each particle, constant until the next interaction; null: none. Pinned particles stay.
  std::shared_ptr<const std::vector<Particle4>> externalForces;
};

// Reads positions of `count` particles from `first` on.
using ReadPositions = std::function<std::vector<Particle4>(std::uint32_t first, std::uint32_t count)>;

// Takes hold of a particle and of those within `radius` [m] of it on the lattice at rest; the weight falls as
// (1 - (r / radius)^2)^2. Everything keeps its place relative to the particle, where the grab begins.
[[nodiscard]] GrabSpring makeGrabSpring(const Cloth& cloth, std::uint32_t particle, double strength,
                                        double radius, const ReadPositions& positions);
// Where the grab is once `steps` steps are done [m].
[[nodiscard]] Vec3d placeOf(const GrabSpring& grab, std::uint64_t steps);
// From where it is after `step` steps to `target`, in so many steps.
void moveTo(GrabSpring& grab, Vec3d target, std::uint64_t step, int steps);

// For the step from step * h to (step + 1) * h.
template <class Real>
[[nodiscard]] InteractionParams<Real> makeInteractionParams(const Interaction& interaction,
                                                            const Scene& scene, std::uint64_t step);
// A jet needs the forces of the air: those of the default Wind where the scene has none.
template <class Real>
void addJet(const Interaction& interaction, const Scene& scene, shared::StepParams<Real>& params);

}  // namespace clothsim
