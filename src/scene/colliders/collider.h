// The registry of shapes. A new shape is a header and a .cpp in this folder, an alternative here, and a law
// in shaders/shared/shapes.h.
#pragma once

#include <string_view>
#include <variant>

#include "scene/colliders/box.h"
#include "scene/colliders/capsule.h"
#include "scene/colliders/cone.h"
#include "scene/colliders/cylinder.h"
#include "scene/colliders/mesh_collider.h"
#include "scene/colliders/plane.h"
#include "scene/colliders/sphere.h"
#include "scene/colliders/torus.h"

namespace clothsim {

// The place of an alternative is its number, COLLIDER_... of shaders/shared/shapes.h.
using Collider = std::variant<Sphere, Plane, Capsule, Box, Torus, MeshCollider, Cylinder, Cone>;

// One of each shape with its defaults, in the variant's order.
template <class... Shapes>
requires(WrittenShape<Shapes>&&...)
    [[nodiscard]] std::vector<std::variant<Shapes...>> defaultsOf(const std::variant<Shapes...>*) {
  return {std::variant<Shapes...>(Shapes{})...};
}
[[nodiscard]] inline std::vector<Collider> defaultColliders() {
  return defaultsOf(static_cast<const Collider*>(nullptr));
}

// "sphere", "plane" ...: as in scene files.
[[nodiscard]] inline std::string_view typeOf(const Collider& collider) {
  return std::visit([](const auto& shape) { return shape.type; }, collider);
}
// Whether its shape changes in time.
[[nodiscard]] inline bool deforms(const Collider& collider) {
  const auto* mesh = std::get_if<MeshCollider>(&collider);
  return mesh != nullptr && mesh->deforms();
}
// Whether its surface is elsewhere at another time, by a motion or as a body that deforms.
[[nodiscard]] inline bool moves(const Collider& collider) {
  return deforms(collider) ||
         std::visit([](const auto& shape) { return shape.motion.has_value(); }, collider);
}
[[nodiscard]] inline Vec3d& placeOf(Collider& collider) {
  return std::visit([](auto& shape) -> Vec3d& { return shape.place(); }, collider);
}

}  // namespace clothsim
