// Where a collider is at a given time: evaluated on the host in double and handed to both backends and the
// renderer.
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

// The pose at time t [s]; without a motion the collider's own place, unrotated.
[[nodiscard]] Pose poseAt(const Collider& collider, double t);

}  // namespace clothsim
