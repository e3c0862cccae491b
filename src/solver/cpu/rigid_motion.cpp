#include "solver/cpu/rigid_motion.h"

#include <cmath>

namespace clothsim::cpu {
namespace {

constexpr std::size_t SAMPLES = 1024;  // about so many particles tell how all of them move

// The solution of A x = b by Cramer's rule, A by its columns; 0 where A is singular, as of particles in line.
Vec3d solved(const Vec3d (&a)[3], Vec3d b) {
  const double determinant = dot(a[0], cross(a[1], a[2])), size = dot(a[0], a[0]);
  if (!(std::abs(determinant) > 1e-12 * size * std::sqrt(size))) return {};
  const double inverse = 1 / determinant;
  return {inverse * dot(b, cross(a[1], a[2])), inverse * dot(a[0], cross(b, a[2])),
          inverse * dot(a[0], cross(a[1], b))};
}

}  // namespace

template <class Real>
RigidMotion::RigidMotion(const Components<Real>& positions, const Components<Real>& velocities) {
  const std::size_t particles = positions.x.size(), stride = 1 + particles / SAMPLES;
  if (particles == 0) return;
  const std::size_t count = (particles - 1) / stride + 1;
  const Arrays<const Real> x = arraysOf(positions), v = arraysOf(velocities);
  const auto placeAt = [&](std::size_t i) {
    return at(x, static_cast<std::ptrdiff_t>(i * stride)).template cast<double>();
  };
  const auto velocityAt = [&](std::size_t i) {
    return at(v, static_cast<std::ptrdiff_t>(i * stride)).template cast<double>();
  };
  for (std::size_t i = 0; i < count; ++i) {
    center_ = center_ + placeAt(i);
    velocity_ = velocity_ + velocityAt(i);
  }
  const double share = 1.0 / static_cast<double>(count);
  center_ = share * center_;
  velocity_ = share * velocity_;
  Vec3d momentum, squares, mixed;  // mixed: of y z, z x, x y
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d d = placeAt(i) - center_;
    momentum = momentum + cross(d, velocityAt(i));
    squares = squares + Vec3d{d.x * d.x, d.y * d.y, d.z * d.z};
    mixed = mixed + Vec3d{d.y * d.z, d.z * d.x, d.x * d.y};
  }
  angularVelocity_ = solved({{squares.y + squares.z, -mixed.z, -mixed.y},
                             {-mixed.z, squares.z + squares.x, -mixed.x},
                             {-mixed.y, -mixed.x, squares.x + squares.y}},
                            momentum);
}

template <class Real>
RigidMap<Real> RigidMotion::after(double time) const {
  const Vec3d turn = time * angularVelocity_;
  const double angle = std::sqrt(dot(turn, turn));
  const Vec3d axis = angle > 0 ? (1 / angle) * turn : Vec3d{1, 0, 0};
  const double c = std::cos(angle), s = std::sin(angle);
  const auto row = [&](Vec3d e) {  // of c + s [axis] + (1 - c) axis axis^T (O. Rodrigues, 1840)
    return (c * e + s * cross(e, axis) + ((1 - c) * dot(axis, e)) * axis).template cast<Real>();
  };
  return {{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})},
          center_.cast<Real>(),
          (center_ + time * velocity_).cast<Real>()};
}

template RigidMotion::RigidMotion(const Components<float>&, const Components<float>&);
template RigidMotion::RigidMotion(const Components<double>&, const Components<double>&);
template RigidMap<float> RigidMotion::after(double) const;
template RigidMap<double> RigidMotion::after(double) const;

}  // namespace clothsim::cpu
