// Four and eight numbers that are worked on at once, by the operators of the compiler.
#pragma once

#include <type_traits>

#include "core/exact_math.h"
#include "core/vec.h"
#include "solver/cpu/arrays.h"

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed between inlined functions only

namespace clothsim::cpu {

template <class Real>
struct VectorsOf;
template <>
struct VectorsOf<float> {
  using Four = float __attribute__((vector_size(16)));
  using Eight = float __attribute__((vector_size(32)));
};
template <>
struct VectorsOf<double> {
  using Four = double __attribute__((vector_size(32)));
  using Eight = double __attribute__((vector_size(64)));
};

template <class Real>
using Eight = typename VectorsOf<Real>::Eight;
// Three numbers and a 0.
template <class Real>
using Four = typename VectorsOf<Real>::Four;
template <class Real>
INLINE Four<Real> fourOf(Vec3<Real> v) {
  return Four<Real>{v.x, v.y, v.z, Real(0)};
}
template <class Real>
INLINE Four<Real> fourAt(const Arrays<const Real>& c, std::ptrdiff_t i) {
  return Four<Real>{c.x[i], c.y[i], c.z[i], Real(0)};
}
template <class Vector>
INLINE auto threeOf(Vector v) -> Vec3<std::remove_cvref_t<decltype(v[0])>> {
  return {v[0], v[1], v[2]};
}
// The cross product of the first three; rounds as cross() of core/vec.h does.
template <class Vector>
INLINE Vector crossOf(Vector a, Vector b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}

// canonical() of each.
template <class Vector>
INLINE Vector canonicalOf(Vector v) {
  if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v[0])>, double>) return v;
  const Vector magnitude = v < Vector{} ? -v : v;
  return magnitude < Vector{} + 0x1p-40f ? Vector{} : v;
}

}  // namespace clothsim::cpu
