#include "scene/rotation.h"

#include <cmath>
#include <numbers>

namespace clothsim {

Matrix3 rotationMatrix(Vec3d degrees) {
  const double angleDegrees = std::sqrt(dot(degrees, degrees));
  if (angleDegrees == 0) return identityMatrix;
  const Vec3d axis = (1 / angleDegrees) * degrees;
  const double angle = angleDegrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  // Rodrigues: R = c I + s [axis]x + (1 - c) axis axis^T
  const auto row = [&](double along, Vec3d unit, Vec3d skew) {
    return c * unit + s * skew + ((1 - c) * along) * axis;
  };
  return {row(axis.x, {1, 0, 0}, {0, -axis.z, axis.y}), row(axis.y, {0, 1, 0}, {axis.z, 0, -axis.x}),
          row(axis.z, {0, 0, 1}, {-axis.y, axis.x, 0})};
}

Matrix3 rotationFromY(Vec3d axis) {
  const Vec3d y = (1 / std::sqrt(dot(axis, axis))) * axis;
  const double sine = std::hypot(y.x, y.z);
  if (sine == 0) return rotationMatrix({y.y < 0 ? 180.0 : 0.0, 0, 0});
  const double degrees = std::atan2(sine, y.y) * 180 / std::numbers::pi;
  return rotationMatrix({degrees * y.z / sine, 0, -degrees * y.x / sine});
}

Vec3d rotate(const Matrix3& rotation, Vec3d v) {
  return {dot(rotation[0], v), dot(rotation[1], v), dot(rotation[2], v)};
}

Vec3d rotateBack(const Matrix3& rotation, Vec3d v) {
  return v.x * rotation[0] + v.y * rotation[1] + v.z * rotation[2];
}

Matrix3 transposed(const Matrix3& a) {
  return {Vec3d{a[0].x, a[1].x, a[2].x}, Vec3d{a[0].y, a[1].y, a[2].y}, Vec3d{a[0].z, a[1].z, a[2].z}};
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  return {rotateBack(b, a[0]), rotateBack(b, a[1]), rotateBack(b, a[2])};
}

}  // namespace clothsim
