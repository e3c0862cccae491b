// Colliders that the user moves from one place to another.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace clothsim {

// The scene while the collider goes straight from where it is at time `from` [s] to `position` [m], where it
// arrives at `until`. Meanwhile only the rotation of its own path goes on.
[[nodiscard]] Scene withColliderOnItsWay(Scene scene, std::size_t collider, Vec3d position, double from,
                                         double until);
// The scene once it is at `position` at time `now` [s]: it stays there, or its whole path is shifted.
[[nodiscard]] Scene withColliderAt(Scene scene, std::size_t collider, Vec3d position, double now);

}  // namespace clothsim
