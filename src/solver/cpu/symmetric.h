// Symmetric 3 x 3 matrices of the implicit integrator; the twin of shaders/sim/implicit/symmetric.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/exact_math.h"
#include "core/vec.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

template <class Real>
struct Symmetric {
  Vec3<Real> diagonal, others;  // xx, yy, zz and xy, xz, yz
};

template <class Real>
INLINE Symmetric<Real> operator+(const Symmetric<Real>& a, const Symmetric<Real>& b) {
  return {a.diagonal + b.diagonal, a.others + b.others};
}
template <class Real>
INLINE Symmetric<Real> operator*(Real s, const Symmetric<Real>& a) {
  return {s * a.diagonal, s * a.others};
}
// s v v^T
template <class Real>
INLINE Symmetric<Real> outerProduct(Real s, Vec3<Real> v) {
  const Vec3<Real> w = s * v;
  return {{w.x * v.x, w.y * v.y, w.z * v.z}, {w.x * v.y, w.x * v.z, w.y * v.z}};
}
template <class Real>
INLINE Vec3<Real> operator*(const Symmetric<Real>& a, Vec3<Real> v) {
  const Vec3<Real>&d = a.diagonal, &o = a.others;
  return {(d.x * v.x + o.x * v.y) + o.y * v.z, (o.x * v.x + d.y * v.y) + o.z * v.z,
          (o.y * v.x + o.z * v.y) + d.z * v.z};
}

// a = L D L^T: l21, l31, l32 and 1/d1, 1/d2, 1/d3.
template <class Real>
struct Factors {
  Vec3<Real> lower, inverse;
};

// Pivots are at least 1e-6 of the trace: below, binary32 holds no more of them. Without a trace, all is 0.
template <class Real>
INLINE Factors<Real> factorize(const Symmetric<Real>& a) {
  const Real least = static_cast<Real>(1e-6f) * ((a.diagonal.x + a.diagonal.y) + a.diagonal.z);
  const Real i1 = reciprocal(larger(a.diagonal.x, least));
  const Real l21 = a.others.x * i1, l31 = a.others.y * i1;
  const Real i2 = reciprocal(larger(a.diagonal.y - l21 * a.others.x, least));
  const Real rest = a.others.z - l21 * a.others.y;
  const Real l32 = rest * i2;
  const Real i3 = reciprocal(larger((a.diagonal.z - l31 * a.others.y) - l32 * rest, least));
  const bool some = least > static_cast<Real>(0x1p-60f);
  return {{some ? l21 : Real(0), some ? l31 : Real(0), some ? l32 : Real(0)},
          {some ? i1 : Real(0), some ? i2 : Real(0), some ? i3 : Real(0)}};
}

// a^-1 r
template <class Real>
INLINE Vec3<Real> solve(const Factors<Real>& a, Vec3<Real> r) {
  const Real y2 = r.y - a.lower.x * r.x;
  const Real y3 = (r.z - a.lower.y * r.x) - a.lower.z * y2;
  const Real z3 = a.inverse.z * y3;
  const Real z2 = a.inverse.y * y2 - a.lower.z * z3;
  const Real z1 = (a.inverse.x * r.x - a.lower.x * z2) - a.lower.y * z3;
  return {z1, z2, z3};
}

// One a particle or vertex.
template <class Real>
struct SymmetricField {
  std::vector<Real> xx, yy, zz, xy, xz, yz;

  [[nodiscard]] std::array<std::vector<Real>*, 6> all() { return {&xx, &yy, &zz, &xy, &xz, &yz}; }
  void resize(std::size_t size) {
    for (std::vector<Real>* component : all()) component->resize(size);
  }
};

template <class Real>
INLINE Symmetric<Real> at(const SymmetricField<Real>& field, std::ptrdiff_t i) {
  return {{field.xx.data()[i], field.yy.data()[i], field.zz.data()[i]},
          {field.xy.data()[i], field.xz.data()[i], field.yz.data()[i]}};
}
template <class Real>
INLINE void put(SymmetricField<Real>& field, std::ptrdiff_t i, const Symmetric<Real>& a) {
  field.xx.data()[i] = a.diagonal.x;
  field.yy.data()[i] = a.diagonal.y;
  field.zz.data()[i] = a.diagonal.z;
  field.xy.data()[i] = a.others.x;
  field.xz.data()[i] = a.others.y;
  field.yz.data()[i] = a.others.z;
}
template <class Real>
INLINE void addTo(SymmetricField<Real>& field, std::ptrdiff_t i, const Symmetric<Real>& a) {
  put(field, i, at(field, i) + a);
}

}  // namespace clothsim::cpu
