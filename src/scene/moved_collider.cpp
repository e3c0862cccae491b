#include "scene/moved_collider.h"

#include "scene/pose.h"
#include "scene/rotation_vector.h"

namespace clothsim {
namespace {

// Turns the shape beyond its own rotation, before any motion. A ball looks the same however it is turned, and
// a round shape about its axis, too.
template <class Shape>
void turnShape(Shape& shape, const Matrix3& turn) {
  if constexpr (requires { shape.rotation; })
    shape.rotation = rotationVector(product(turn, shape.ownRotation()));
  else if constexpr (requires { shape.axis; })
    shape.axis = rotate(turn, shape.axis);
  else if constexpr (requires { shape.normal; })
    shape.normal = rotate(turn, shape.normal);
}

}  // namespace

Scene withColliderOnItsWay(Scene scene, const ColliderMove& move, double from, double until) {
  Collider& collider = scene.colliders[move.collider];
  const Vec3d start = poseAt(collider, from).position;
  const Vec3d goal = move.position.value_or(poseAt(collider, until).position);
  std::visit(
      [&](auto& shape) {
        Motion way;
        way.keys = {{from, start, {0, 0, 0}}, {until, goal, {0, 0, 0}}};
        if (shape.motion && !shape.motion->keys.empty()) {
          const Motion::Key before = keyAt(*shape.motion, from), after = keyAt(*shape.motion, until);
          const bool beginsAnew = after.t < before.t;  // the path is a loop, whose end it passes
          way.keys[0].rotation = before.rotation;
          way.keys[1].rotation = beginsAnew ? before.rotation : after.rotation;
        }
        if (move.turn) {
          // Rotation vectors are interpolated, so that the way begins with none: what the path has turned it
          // by becomes its own rotation.
          const Matrix3 before = rotationMatrix(way.keys[0].rotation),
                        after = rotationMatrix(way.keys[1].rotation);
          turnShape(shape, before);
          way.keys[0].rotation = {0, 0, 0};
          way.keys[1].rotation = rotationVector(product(*move.turn, product(after, transposed(before))));
        }
        shape.motion = way;
      },
      collider);
  return scene;
}

Scene withColliderAtRest(Scene scene, std::size_t collider, double now) {
  const Pose pose = poseAt(scene.colliders[collider], now);
  std::visit(
      [&](auto& shape) {
        if (!shape.motion) return;
        turnShape(shape, pose.rotation);
        shape.place() = pose.position;
        shape.motion.reset();
      },
      scene.colliders[collider]);
  return scene;
}

Scene withColliderMoved(Scene scene, const ColliderMove& move, double now) {
  Collider& collider = scene.colliders[move.collider];
  const Pose pose = poseAt(collider, now);
  // A path turns the shape beyond its own rotation.
  if (move.turn)
    std::visit(
        [&](auto& shape) {
          turnShape(shape, product(transposed(pose.rotation), product(*move.turn, pose.rotation)));
        },
        collider);
  if (!move.position) return scene;
  const Vec3d offset = *move.position - pose.position;
  placeOf(collider) = *move.position;
  std::visit(
      [&](auto& shape) {
        if (!shape.motion) return;
        for (Motion::Key& key : shape.motion->keys) key.position = key.position + offset;
      },
      collider);
  return scene;
}

}  // namespace clothsim
