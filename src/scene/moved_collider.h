// Colliders that a hand moves from one place to another.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace clothsim {

// The scene while the collider goes from where it is at `from` [s] straight to `position` [m], where it
// arrives at `until`. A path of its own is left alone meanwhile, but for the turning.
[[nodiscard]] Scene withColliderOnItsWay(Scene scene, std::size_t collider, Vec3d position, double from,
                                         double until);
// The scene once it is at `position` at time `now` [s]: it stays there, or its whole path is shifted.
[[nodiscard]] Scene withColliderAt(Scene scene, std::size_t collider, Vec3d position, double now);

}  // namespace clothsim
