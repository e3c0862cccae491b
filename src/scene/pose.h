// Where a collider or a motion is at a given time: evaluated on the host in double and handed to both
// backends and the renderer.
#pragma once

#include <array>

#include "scene/scene.h"

namespace clothsim {

using Matrix3 = std::array<Vec3d, 3>;  // rows

struct Pose {
  Vec3d position;  // the sphere's centre, the plane's point [m]
  Matrix3 rotation{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
};

// Rodrigues' formula for a rotation vector in degrees.
[[nodiscard]] Matrix3 rotationMatrix(Vec3d degrees);
[[nodiscard]] Vec3d rotate(const Matrix3& rotation, Vec3d v);
[[nodiscard]] Vec3d rotateBack(const Matrix3& rotation, Vec3d v);  // by the transpose

// The rotation by which a shape's own frame (capsules and tori around y, planes with the normal along y,
// boxes along the axes) stands in the world, before any motion.
[[nodiscard]] Matrix3 ownRotation(const Collider& collider);
// The product a b, which applies b first.
[[nodiscard]] Matrix3 product(const Matrix3& a, const Matrix3& b);

// The key of a motion, which has at least one, at time t [s]: linear between those given.
[[nodiscard]] Motion::Key keyAt(const Motion& motion, double t);

// The pose at time t [s]; without a motion the collider's own place, unrotated.
[[nodiscard]] Pose poseAt(const Collider& collider, double t);
// The pose of a motion that has at least one key.
[[nodiscard]] Pose poseAt(const Motion& motion, double t);

}  // namespace clothsim
