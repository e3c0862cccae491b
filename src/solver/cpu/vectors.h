// Four, eight and sixteen numbers that are worked on at once, by the operators of the compiler.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include "core/exact_math.h"
#include "core/vec.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/rows.h"

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed between inlined functions only

namespace clothsim::cpu {

template <class Real>
struct VectorsOf;
template <>
struct VectorsOf<float> {
  using Four = float __attribute__((vector_size(16)));
  using Eight = float __attribute__((vector_size(32)));
  using Sixteen = float __attribute__((vector_size(64)));
};
template <>
struct VectorsOf<double> {
  using Four = double __attribute__((vector_size(32)));
  using Eight = double __attribute__((vector_size(64)));
  using Sixteen = double __attribute__((vector_size(128)));
};

template <class Real>
using Eight = typename VectorsOf<Real>::Eight;
template <class Real>
using Sixteen = typename VectorsOf<Real>::Sixteen;
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

// Vectors of four as numbers that lie one behind the other. putFour() writes the last number of three twice:
// a store of four variables stays one of a vector, with a constant it does not.
template <class Real>
struct alignas(4 * sizeof(Real)) FourNumbers {
  Real numbers[4];
};
template <class Real>
INLINE Four<Real> vectorAt(const Real* vectors, std::size_t k) {
  return *reinterpret_cast<const Four<Real>*>(vectors + 4 * k);
}
template <class Real>
INLINE void putFour(Real* vectors, std::size_t k, Vec3<Real> v) {
  Real* to = vectors + 4 * k;
  to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = v.z;
}
// Of lane k, the first three numbers of vector numberAt(k), by component: loaded as vectors and then sorted,
// which takes fewer instructions than loading them one by one.
template <class Real, class NumberAt>
INLINE void gatherFours(const Real* vectors, std::ptrdiff_t count, NumberAt numberAt, Real* x, Real* y,
                        Real* z) {
  std::ptrdiff_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const Four<Real> a = vectorAt(vectors, numberAt(k)), b = vectorAt(vectors, numberAt(k + 1)),
                     c = vectorAt(vectors, numberAt(k + 2)), d = vectorAt(vectors, numberAt(k + 3));
    const Four<Real> xyOfTwo = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                     xyOfOthers = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                     zOfTwo = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                     zOfOthers = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    const Four<Real> xs = __builtin_shufflevector(xyOfTwo, xyOfOthers, 0, 1, 4, 5),
                     ys = __builtin_shufflevector(xyOfTwo, xyOfOthers, 2, 3, 6, 7),
                     zs = __builtin_shufflevector(zOfTwo, zOfOthers, 0, 1, 4, 5);
    std::memcpy(x + k, &xs, sizeof(xs));
    std::memcpy(y + k, &ys, sizeof(ys));
    std::memcpy(z + k, &zs, sizeof(zs));
  }
  for (; k < count; ++k) {
    const Real* from = vectors + 4 * numberAt(k);
    x[k] = from[0], y[k] = from[1], z[k] = from[2];
  }
}

// Up to sixteen vectors, by component.
template <class Real>
struct Lanes {
  alignas(64) Real x[SIXTEEN], y[SIXTEEN], z[SIXTEEN];
};
template <class Real>
INLINE Vec3<Real> at(const Lanes<Real>& lanes, std::ptrdiff_t lane) {
  return {lanes.x[lane], lanes.y[lane], lanes.z[lane]};
}
template <class Real>
INLINE void put(Lanes<Real>& lanes, std::ptrdiff_t lane, Vec3<Real> v) {
  lanes.x[lane] = v.x;
  lanes.y[lane] = v.y;
  lanes.z[lane] = v.z;
}
// canonical() of each.
template <class Vector>
INLINE Vector canonicalOf(Vector v) {
  if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v[0])>, double>) return v;
  const Vector magnitude = v < Vector{} ? -v : v;
  return magnitude < Vector{} + 0x1p-40f ? Vector{} : v;
}

}  // namespace clothsim::cpu
