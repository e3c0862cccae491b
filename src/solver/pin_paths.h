// Pins in motion: which particles move, and the rigid motion of each group of them, evaluated on the host for
// both backends. Cheap to keep: it changes with the scene, not with the step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "shared/step_params.h"

namespace clothsim {

template <class Real>
using PinMotionParams = shared::PinMotionParams<Real>;

// One `pin_motion` of a cloth, with the centre of its pins.
struct PinPath {
  Vec3d center;   // mean of the start positions of its pins [m]
  Motion motion;  // where the centre is; every key has a position
};

struct PinPaths {
  std::vector<PinPath> paths;  // of all cloths, in the scene's order
  // For each particle the number of its path + 1, 0 for those that follow none; empty without any path.
  std::vector<std::uint32_t> numbers;
};
// `offPath`: particles that follow none, whatever the scene says (State::offPath).
[[nodiscard]] PinPaths makePinPaths(const Scene& scene, const Cloth& cloth,
                                    std::span<const std::uint32_t> offPath = {});

// From the start positions to those at `time` [s] (not from step to step, which would drift).
template <class Real>
[[nodiscard]] PinMotionParams<Real> makePinMotionParams(const PinPath& path, double time);

[[nodiscard]] inline bool hasPinMotion(const Scene& scene) {
  for (const ClothSettings& cloth : scene.cloths)
    if (!cloth.pinMotion.empty()) return true;
  return false;
}

}  // namespace clothsim
