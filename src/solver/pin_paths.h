// Pins in motion: which particles move, and the rigid motion of each group of them, evaluated on the host for
// both backends. Cheap to keep: it changes with the scene, not with the step.
//
// Pins of a path with free keys are held for a while. They are where the cloth is when that begins, and go to
// their path as a hand would: x' = x + d, d = (1 - exp(-h / HAND_TIME)) (path - x), but |d| at most h
// HAND_SPEED.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "scene/colliders/signed_distance_grid.h"
#include "scene/scene.h"
#include "shared/step_params.h"

namespace clothsim {

template <class Real>
using PinMotionParams = shared::PinMotionParams<Real>;

inline constexpr double HAND_TIME = 0.15;  // [s]
inline constexpr double HAND_SPEED = 2.5;  // [m/s]

// A place on a body that deforms, and the triangle that it turns with.
struct SurfaceSpot {
  std::shared_ptr<const SignedDistanceGrid> grid;
  MeshPoint point;
};

// One `pin_motion` of a cloth, with the centre of its pins. Pins on a body that deforms have a path each
// beside it, from the place of the surface that is nearest to the pin at the start.
struct PinPath {
  Vec3d center;                             // mean of the start positions of its pins [m]
  Motion motion;                            // where the centre is; every key has a position
  std::vector<bool> isFree;                 // from each key on; empty: always pinned
  std::optional<double> release;            // from when on they are free for good [s]
  std::optional<Collider> body;             // which they move with, instead of the motion;
  std::shared_ptr<const SurfaceSpot> spot;  // and where on it, if it deforms
};
// Whether its particles are pinned in the step that begins at `time` [s].
[[nodiscard]] bool isHeld(const PinPath& path, double time);

struct PinPaths {
  std::vector<PinPath> paths;  // of all cloths, in the scene's order; behind them those of single pins
  // For each particle the number of its path + 1, 0 for those that follow none; empty without any path.
  std::vector<std::uint32_t> numbers;
};
// `offPath`: particles that follow none, whatever the scene says (State::offPath).
[[nodiscard]] PinPaths makePinPaths(const Scene& scene, const Cloth& cloth,
                                    std::span<const std::uint32_t> offPath = {});

// From the start positions to those at `time` [s] (not from step to step, which would drift). `h`: the length
// of the step [s].
template <class Real>
[[nodiscard]] PinMotionParams<Real> makePinMotionParams(const PinPath& path, double time, double h);

[[nodiscard]] inline bool hasPinMotion(const Scene& scene) {
  for (const ClothSettings& cloth : scene.cloths)
    if (!cloth.pinMotion.empty()) return true;
  return false;
}

}  // namespace clothsim
