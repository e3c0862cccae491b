// Vectors and symmetric matrices out of arrays of their components, and back.
#pragma once

#include <cstddef>
#include <type_traits>

#include "core/exact_math.h"
#include "core/vec.h"
#include "core/vector_clones.h"
#include "solver/cpu/cpu_state.h"
#include "solver/cpu/symmetric.h"

namespace clothsim::cpu {

// Where the components of an array lie, so that loops along a row keep them in registers.
template <class Real>
struct Arrays {
  Real *x, *y, *z;
};
template <class Real>
INLINE Arrays<Real> arraysOf(Components<Real>& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}
template <class Real>
INLINE Arrays<const Real> arraysOf(const Components<Real>& c) {
  return {c.x.data(), c.y.data(), c.z.data()};
}
template <class Real>
struct SymmetricArrays {
  Real *xx, *yy, *zz, *xy, *xz, *yz;
};
template <class Real>
INLINE SymmetricArrays<Real> arraysOf(SymmetricField<Real>& f) {
  return {f.xx.data(), f.yy.data(), f.zz.data(), f.xy.data(), f.xz.data(), f.yz.data()};
}

template <class Real>
INLINE Vec3<std::remove_const_t<Real>> at(const Arrays<Real>& c, std::ptrdiff_t i) {
  return {c.x[i], c.y[i], c.z[i]};
}
template <class Real>
INLINE void put(const Arrays<Real>& c, std::ptrdiff_t i, Vec3<Real> v) {
  c.x[i] = v.x;
  c.y[i] = v.y;
  c.z[i] = v.z;
}
// The same numbers, counted from the one that is at `from`.
template <class Real>
INLINE Arrays<Real> countedFrom(std::ptrdiff_t from, const Arrays<Real>& c) {
  return {c.x + from, c.y + from, c.z + from};
}
template <class Real>
INLINE Vec3<Real> at(const Components<Real>& c, std::ptrdiff_t i) {
  return at(arraysOf(c), i);
}
template <class Real>
INLINE void put(Components<Real>& c, std::ptrdiff_t i, Vec3<Real> v) {
  put(arraysOf(c), i, v);
}
template <class Real>
INLINE Symmetric<Real> at(const SymmetricArrays<Real>& field, std::ptrdiff_t i) {
  return {{field.xx[i], field.yy[i], field.zz[i]}, {field.xy[i], field.xz[i], field.yz[i]}};
}
template <class Real>
INLINE void put(const SymmetricArrays<Real>& field, std::ptrdiff_t i, const Symmetric<Real>& a) {
  field.xx[i] = a.diagonal.x;
  field.yy[i] = a.diagonal.y;
  field.zz[i] = a.diagonal.z;
  field.xy[i] = a.others.x;
  field.xz[i] = a.others.y;
  field.yz[i] = a.others.z;
}
template <class Real>
INLINE void addTo(const SymmetricArrays<Real>& field, std::ptrdiff_t i, const Symmetric<Real>& a) {
  put(field, i, at(field, i) + a);
}
using clothsim::canonical;
template <class Real>
INLINE Vec3<Real> canonical(Vec3<Real> v) {
  return {clothsim::canonical(v.x), clothsim::canonical(v.y), clothsim::canonical(v.z)};
}
template <class Real>
INLINE Vec3<Real> selected(bool first, Vec3<Real> a, Vec3<Real> b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

}  // namespace clothsim::cpu
