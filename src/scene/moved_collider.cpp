#include "scene/moved_collider.h"

#include "scene/pose.h"

namespace clothsim {
Scene withColliderOnItsWay(Scene scene, std::size_t index, Vec3d position, double from, double until) {
  Collider& collider = scene.colliders[index];
  const Vec3d start = poseAt(collider, from).position;
  std::visit(
      [&](auto& shape) {
        Motion way;
        way.keys = {{from, start, {0, 0, 0}}, {until, position, {0, 0, 0}}};
        if (shape.motion && !shape.motion->keys.empty()) {
          const Motion::Key before = keyAt(*shape.motion, from), after = keyAt(*shape.motion, until);
          const bool beginsAnew = after.t < before.t;  // the path is a loop, whose end it passes
          way.keys[0].rotation = before.rotation;
          way.keys[1].rotation = beginsAnew ? before.rotation : after.rotation;
        }
        shape.motion = way;
      },
      collider);
  return scene;
}

Scene withColliderAt(Scene scene, std::size_t index, Vec3d position, double now) {
  Collider& collider = scene.colliders[index];
  const Vec3d offset = position - poseAt(collider, now).position;
  placeOf(collider) = position;
  std::visit(
      [&](auto& shape) {
        if (!shape.motion) return;
        for (Motion::Key& key : shape.motion->keys) key.position = key.position + offset;
      },
      collider);
  return scene;
}

}  // namespace clothsim
