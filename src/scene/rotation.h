// Rotations in three dimensions, in double.
#pragma once

#include <array>

#include "core/vec.h"

namespace clothsim {

using Matrix3 = std::array<Vec3d, 3>;  // rows
inline constexpr Matrix3 identityMatrix{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

// Rodrigues' formula for a rotation vector in degrees.
[[nodiscard]] Matrix3 rotationMatrix(Vec3d degrees);
// The rotation by the smallest angle that takes y to `axis`, which has any length but 0; about x where they
// are opposite.
[[nodiscard]] Matrix3 rotationFromY(Vec3d axis);
[[nodiscard]] Vec3d rotate(const Matrix3& rotation, Vec3d v);
[[nodiscard]] Vec3d rotateBack(const Matrix3& rotation, Vec3d v);  // by the transpose
[[nodiscard]] Matrix3 transposed(const Matrix3& a);
// b first, then a.
[[nodiscard]] Matrix3 product(const Matrix3& a, const Matrix3& b);

}  // namespace clothsim
