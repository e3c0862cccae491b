// Motions, and colliders that follow them.
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clothsim {

namespace {

template <class Shape>
Vec3d ownPlace(const Shape& shape) {
  return shape.origin;
}
Vec3d ownPlace(const Plane& plane) { return plane.point; }

// The shortest turn that takes y to `axis`; about x where they are opposite.
Matrix3 turnFromY(Vec3d axis) {
  const Vec3d y = (1 / std::sqrt(dot(axis, axis))) * axis;
  const double sine = std::hypot(y.x, y.z);
  if (sine == 0) return rotationMatrix({y.y < 0 ? 180.0 : 0.0, 0, 0});
  const double degrees = std::atan2(sine, y.y) * 180 / std::numbers::pi;
  return rotationMatrix({degrees * y.z / sine, 0, -degrees * y.x / sine});
}

Matrix3 rotationOf(const Sphere&) { return Pose{}.rotation; }
Matrix3 rotationOf(const Plane& plane) { return turnFromY(plane.normal); }
Matrix3 rotationOf(const Capsule& capsule) { return turnFromY(capsule.axis); }
Matrix3 rotationOf(const Torus& torus) { return turnFromY(torus.axis); }
Matrix3 rotationOf(const Box& box) { return rotationMatrix(box.rotation); }
Matrix3 rotationOf(const MeshCollider& mesh) { return rotationMatrix(mesh.rotation); }

double wrapped(double t, double period) {
  const double rest = std::fmod(t, period);
  return rest < 0 ? rest + period : rest;
}

}  // namespace

Motion::Key keyAt(const Motion& motion, double t) {
  const auto& keys = motion.keys;
  if (motion.loop && keys.back().t > 0) t = wrapped(t, keys.back().t);
  const auto later = std::upper_bound(keys.begin(), keys.end(), t,
                                      [](double time, const Motion::Key& key) { return time < key.t; });
  if (later == keys.begin()) return keys.front();
  if (later == keys.end()) return keys.back();
  const Motion::Key& a = *(later - 1);
  const Motion::Key& b = *later;
  const double s = (t - a.t) / (b.t - a.t);
  return {t, a.position + s * (b.position - a.position), a.rotation + s * (b.rotation - a.rotation)};
}

Matrix3 rotationMatrix(Vec3d degrees) {
  const double angleDegrees = std::sqrt(dot(degrees, degrees));
  if (angleDegrees == 0) return Pose{}.rotation;
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

Vec3d rotate(const Matrix3& rotation, Vec3d v) {
  return {dot(rotation[0], v), dot(rotation[1], v), dot(rotation[2], v)};
}

Vec3d rotateBack(const Matrix3& rotation, Vec3d v) {
  return v.x * rotation[0] + v.y * rotation[1] + v.z * rotation[2];
}

Matrix3 ownRotation(const Collider& collider) {
  return std::visit([](const auto& shape) { return rotationOf(shape); }, collider);
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  return {rotateBack(b, a[0]), rotateBack(b, a[1]), rotateBack(b, a[2])};
}

Pose poseAt(const Collider& collider, double t) {
  return std::visit(
      [t](const auto& shape) {
        if (!shape.motion || shape.motion->keys.empty()) return Pose{ownPlace(shape)};
        return poseAt(*shape.motion, t);
      },
      collider);
}

Pose poseAt(const Motion& motion, double t) {
  const Motion::Key key = keyAt(motion, t);
  return {key.position, rotationMatrix(key.rotation)};
}

}  // namespace clothsim
