// The compute programs of a step, compiled for what one grid's scene needs: springs, wind or colliders that
// are not there cost nothing, which matters on drivers that run both sides of a branch.
#pragma once

#include <cstdint>

#include "cloth/cloth.h"
#include "gl/program.h"
#include "scene/scene.h"
#include "solver/hand.h"

namespace clothsim {

struct PassFeatures {
  bool wind = false, airResistance = false, movingColliders = false, coulombFriction = false,
       movingPins = false, restLengthTable = false;
  bool hold = false, jet = false, cuts = false;  // a hand's doing
  std::uint32_t colliderTypes = 0;               // one bit a COLLIDER_... type of shared/step_params.h
  std::uint32_t enabledSlots = 0;                // one bit a SpringSlot
  int groupColumns = 64, groupRows = 1;
  bool fused = true;           // forces and integration in one dispatch,
  bool collidesInStep = true;  // and colliders, when no pass comes between;
  bool collidesAgain = false;  // they come again later
  friend auto operator<=>(const PassFeatures&, const PassFeatures&) = default;
};

[[nodiscard]] PassFeatures featuresOf(const Scene& scene, const Cloth& cloth, std::size_t grid,
                                      const Hand& hand = {}, const Cuts& cuts = {});
[[nodiscard]] gl::Defines definesFor(const PassFeatures& features);

struct PassPrograms {
  explicit PassPrograms(const PassFeatures& features);

  gl::Program step;                        // when fused,
  gl::Program forces, integrate, collide;  // when not
  gl::Program limit, watchLimit, kick, start;
};

}  // namespace clothsim
