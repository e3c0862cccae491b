// Three-vectors in a fixed order of rounding: only + - * on components, sums from left to right. Simulation
// code uses these instead of GLM, because the order of rounding is part of the numeric contract
// (docs/numeric-contract.md).
#pragma once

#include <cmath>

namespace clothsim {

template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  template <class Other>
  [[nodiscard]] constexpr Vec3<Other> cast() const {
    return {static_cast<Other>(x), static_cast<Other>(y), static_cast<Other>(z)};
  }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

template <class Real>
constexpr Vec3<Real> operator+(Vec3<Real> a, Vec3<Real> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
constexpr Vec3<Real> operator-(Vec3<Real> a, Vec3<Real> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
constexpr Vec3<Real> operator*(Real s, Vec3<Real> a) {
  return {s * a.x, s * a.y, s * a.z};
}
// (ax bx + ay by) + az bz
template <class Real>
constexpr Real dot(Vec3<Real> a, Vec3<Real> b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class Real>
constexpr Vec3<Real> cross(Vec3<Real> a, Vec3<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// For measuring and for shapes. Passes of the simulation use inverseSquareRoot (core/exact_math.h) instead.
inline double length(Vec3d v) { return std::sqrt(dot(v, v)); }

}  // namespace clothsim
