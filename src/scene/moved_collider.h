// Colliders that the user moves and turns.
#pragma once

#include <cstddef>
#include <optional>

#include "scene/rotation.h"
#include "scene/scene.h"

namespace clothsim {

// Where a collider is to go, and how far it is to turn about its origin or point meanwhile.
struct ColliderMove {
  std::size_t collider = 0;          // in scene.colliders
  std::optional<Vec3d> position;     // [m]; none: where its path takes it
  std::optional<Matrix3> turn = {};  // in the world, beyond what its path turns it
};

// The scene while the collider goes straight from where it is at time `from` [s] to the position, where it
// arrives at `until`, and turns at a steady rate. Meanwhile only the rotation of its own path goes on.
[[nodiscard]] Scene withColliderOnItsWay(Scene scene, const ColliderMove& move, double from, double until);
// The scene once it has arrived, at time `now` [s]: it stays as it is, or its whole path is shifted and
// turned.
[[nodiscard]] Scene withColliderMoved(Scene scene, const ColliderMove& move, double now);
// The scene in which a collider stays from time `now` [s] on where its path has taken it.
[[nodiscard]] Scene withColliderAtRest(Scene scene, std::size_t collider, double now);

[[nodiscard]] inline Scene withColliderOnItsWay(Scene scene, std::size_t collider, Vec3d position,
                                                double from, double until) {
  return withColliderOnItsWay(std::move(scene), ColliderMove{collider, position}, from, until);
}
[[nodiscard]] inline Scene withColliderAt(Scene scene, std::size_t collider, Vec3d position, double now) {
  return withColliderMoved(std::move(scene), ColliderMove{collider, position}, now);
}

}  // namespace clothsim
