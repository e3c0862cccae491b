// Blocks of 6 x 6 that join two aggregates, which move as rigid bodies (solver/implicit.h); the twin of
// shaders/sim/implicit/rigid_block.glsl.
#pragma once

#include <algorithm>
#include <array>

#include "core/exact_math.h"
#include "core/vec.h"
#include "shared/implicit.h"
#include "solver/cpu/vectors.h"

namespace clothsim::cpu {

// A translation and a rotation, or a force and a torque; the number behind either means nothing.
template <class Real>
struct alignas(8 * sizeof(Real)) RigidVector {
  Eight<Real> both{};

  RigidVector() = default;
  INLINE explicit RigidVector(const Eight<Real>& values) : both(values) {}
  INLINE RigidVector(Four<Real> translation, Four<Real> rotation)
      : both(__builtin_shufflevector(translation, rotation, 0, 1, 2, 3, 4, 5, 6, 7)) {}
  [[nodiscard]] INLINE Four<Real> translation() const {
    return __builtin_shufflevector(both, both, 0, 1, 2, 3);
  }
  [[nodiscard]] INLINE Four<Real> rotation() const { return __builtin_shufflevector(both, both, 4, 5, 6, 7); }
};
template <class Real>
INLINE RigidVector<Real> canonical(const RigidVector<Real>& v) {
  return RigidVector<Real>(canonicalOf(v.both));
}

// Their numbers one after another, eight each, for loops that take a vector of every component: a store of
// eight numbers, none of them a constant, stays one of vectors.
template <class Real>
INLINE Real* numbersOf(RigidVector<Real>* vectors) {
  return reinterpret_cast<Real*>(vectors);
}
template <class Real>
struct Threes {
  Vec3<Real> translation, rotation;
};
template <class Real>
INLINE Threes<Real> threesAt(const Real* numbers, std::ptrdiff_t i) {
  const Real* v = numbers + 8 * i;
  return {{v[0], v[1], v[2]}, {v[4], v[5], v[6]}};
}
template <class Real>
INLINE void putThrees(Real* numbers, std::ptrdiff_t i, Vec3<Real> translation, Vec3<Real> rotation) {
  Real* v = numbers + 8 * i;
  v[0] = translation.x, v[1] = translation.y, v[2] = translation.z, v[3] = translation.z;
  v[4] = rotation.x, v[5] = rotation.y, v[6] = rotation.z, v[7] = rotation.z;
}

// Forces and motions of all vertices are about one origin: as they are, they add up from level to level. Here
// a force as it is about `center`, where its torque is another, and a motion about `center` as it is about
// the origin.
template <class Real>
INLINE RigidVector<Real> forceAbout(Four<Real> center, const RigidVector<Real>& force) {
  return {force.translation(), force.rotation() - crossOf(center, force.translation())};
}
template <class Real>
INLINE RigidVector<Real> motionFrom(Four<Real> center, const RigidVector<Real>& motion) {
  return {motion.translation() + crossOf(center, motion.rotation()), motion.rotation()};
}

// Columns of four 3 x 3 matrices: rows by columns, t for translation, r for rotation.
template <class Real>
struct RigidBlock {
  using Columns = std::array<Four<Real>, 3>;
  Columns tt{}, tr{}, rt{}, rr{};
};

template <class Real>
INLINE RigidBlock<Real> canonical(RigidBlock<Real> block) {
  for (auto* columns : {&block.tt, &block.tr, &block.rt, &block.rr})
    for (Four<Real>& column : *columns) column = canonicalOf(column);
  return block;
}

// What elements add to a block, before it is one.
template <class Real>
struct alignas(8 * sizeof(Real)) ElementSums {
  // Of p q^T, a column each: the three of a force, 0, the three of a torque, 0.
  typename VectorsOf<Real>::Eight columns[6]{};
  // Of (y, sigma) (y, sigma)^T, two columns each. The vertices of an element follow a rigid body by
  // sum of c w (t + r x (x - center)) = sigma t + r x y.
  typename VectorsOf<Real>::Eight moments[2]{};
};

template <class Real>
INLINE typename RigidBlock<Real>::Columns transposed(const typename RigidBlock<Real>::Columns& a) {
  typename RigidBlock<Real>::Columns result;
  for (int c = 0; c < 3; ++c)
    result[static_cast<std::size_t>(c)] = Four<Real>{a[0][c], a[1][c], a[2][c], Real(0)};
  return result;
}
template <class Real>
INLINE RigidBlock<Real> transposed(const RigidBlock<Real>& a) {
  return {transposed<Real>(a.tt), transposed<Real>(a.rt), transposed<Real>(a.tr), transposed<Real>(a.rr)};
}

// The block as bodies see it whose centers lie `p` and `q` before those of its own: adds s S(p)^T block S(q),
// S(p) (t, r) = (t + r x p, r).
template <class Real>
INLINE void addShifted(RigidBlock<Real>& sum, Real s, const RigidBlock<Real>& block, Four<Real> p,
                       Four<Real> q) {
  const auto turned = [&](const typename RigidBlock<Real>::Columns& a, std::size_t c)
      __attribute__((always_inline)) {  // a (e_c x q)
    return c == 0   ? q[1] * a[2] - q[2] * a[1]
           : c == 1 ? q[2] * a[0] - q[0] * a[2]
                    : q[0] * a[1] - q[1] * a[0];
  };
#pragma GCC unroll 3
  for (std::size_t c = 0; c < 3; ++c) {
    const Four<Real> tr = block.tr[c] + turned(block.tt, c), rr = block.rr[c] + turned(block.rt, c);
    sum.tt[c] = sum.tt[c] + s * block.tt[c];
    sum.tr[c] = sum.tr[c] + s * tr;
    sum.rt[c] = sum.rt[c] + s * (block.rt[c] + crossOf(p, block.tt[c]));
    sum.rr[c] = sum.rr[c] + s * (rr + crossOf(p, tr));
  }
}

template <class Real>
INLINE RigidVector<Real> operator*(const RigidBlock<Real>& a, const RigidVector<Real>& v) {
  const auto product =
      [](const typename RigidBlock<Real>::Columns& m, Four<Real> u) __attribute__((always_inline)) {
    return (u[0] * m[0] + u[1] * m[1]) + u[2] * m[2];
  };
  const Four<Real> translation = v.translation(), rotation = v.rotation();
  return {product(a.tt, translation) + product(a.tr, rotation),
          product(a.rt, translation) + product(a.rr, rotation)};
}

// The reciprocal of a pivot; 0 where less of it is left than a part of its scale, which may be rounding
// alone, or where nothing is: that unknown stays 0.
template <class Real>
INLINE Real inversePivot(Real pivot, Real scale) {
  const Real least = static_cast<Real>(LEAST_PIVOT) * scale;
  const bool isSafe = scale > static_cast<Real>(0x1p-60) && pivot >= least;
  return isSafe ? reciprocal(pivot) : Real(0);
}

// The six columns of a block.
template <class Real>
using SixColumns = std::array<std::array<Real, 6>, 6>;
template <class Real>
INLINE SixColumns<Real> columnsOf(const RigidBlock<Real>& block) {
  SixColumns<Real> columns;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      columns[c][k] = block.tt[c][k];
      columns[c][3 + k] = block.rt[c][k];
      columns[3 + c][k] = block.tr[c][k];
      columns[3 + c][3 + k] = block.rr[c][k];
    }
  return columns;
}
template <class Real>
INLINE RigidBlock<Real> blockOf(const SixColumns<Real>& columns) {
  RigidBlock<Real> block;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto &t = columns[c], &r = columns[3 + c];
    block.tt[c] = Four<Real>{t[0], t[1], t[2], Real(0)};
    block.rt[c] = Four<Real>{t[3], t[4], t[5], Real(0)};
    block.tr[c] = Four<Real>{r[0], r[1], r[2], Real(0)};
    block.rr[c] = Four<Real>{r[3], r[4], r[5], Real(0)};
  }
  return block;
}

// Minus the inverse of a symmetric matrix of order n, in place: its columns are at columnAt(0), columnAt(1)
// and so on. Every pivot in turn is swept out (Goodnight 1979, "A tutorial on the SWEEP operator"), number
// `begin` first and those before it last. The scale of a pivot, to which its rounding is in proportion, is
// the entry that it began as, plus what each pivot swept out before took from it, times the ratio of that
// pivot's scale to that pivot. `scales` and `pivots` are scratch.
template <class Real, class ColumnAt>
INLINE void sweepOut(std::size_t n, std::size_t begin, Real* scales, Real* pivots, ColumnAt columnAt) {
  for (std::size_t k = 0; k < n; ++k) scales[k] = columnAt(k)[k];
  for (std::size_t swept = 0; swept < n; ++swept) {
    const std::size_t k = begin + swept < n ? begin + swept : begin + swept - n;
    const Real inverse = inversePivot(columnAt(k)[k], scales[k]);
    const Real enlarged = inverse * scales[k];
    std::copy_n(columnAt(k), n, pivots);
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i)
      scales[i] = scales[i] + ((pivots[i] * inverse) * pivots[i]) * enlarged;
    for (std::size_t j = 0; j < n; ++j) {
      Real* column = columnAt(j);
      const Real inColumn = pivots[j] * inverse;
      if (j == k) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) column[i] = clothsim::canonical(pivots[i] * inverse);
      } else {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) column[i] = clothsim::canonical(column[i] - pivots[i] * inColumn);
      }
      column[k] = clothsim::canonical(j == k ? -inverse : inColumn);
    }
  }
}

}  // namespace clothsim::cpu
