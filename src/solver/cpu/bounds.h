// Boxes along the axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "solver/cpu/vectors.h"

namespace clothsim::cpu {

template <class Real>
struct Bounds {
  Four<Real> low, high;
};

template <class Real>
INLINE Bounds<Real> joined(const Bounds<Real>& a, const Bounds<Real>& b) {
  return {b.low < a.low ? b.low : a.low, a.high < b.high ? b.high : a.high};
}
// Of four comparisons a bit each.
template <class Comparisons>
INLINE std::uint32_t bitsOfFour(Comparisons c) {
#ifdef __SSE__
  if constexpr (sizeof(c) == 16)
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<VectorsOf<float>::Four>(c)));
#endif
  std::uint32_t bits = 0;
  for (int k = 0; k < 4; ++k) bits |= c[k] != 0 ? 1u << k : 0u;
  return bits;
}
template <class Real>
INLINE bool overlap(const Bounds<Real>& a, const Bounds<Real>& b) {
  return (bitsOfFour((a.low <= b.high) & (b.low <= a.high)) & 7u) == 7u;
}

// Around what moves linearly: at the start and at the end of its motion.
template <class Real>
struct MovingBounds {
  Bounds<Real> start, end;
};
template <class Real>
INLINE MovingBounds<Real> joined(const MovingBounds<Real>& a, const MovingBounds<Real>& b) {
  return {joined(a.start, b.start), joined(a.end, b.end)};
}
// Whether anything of both may meet at the same time. What lies on one side of something at the start and at
// the end, does so on the whole way.
template <class Real>
INLINE bool overlap(const MovingBounds<Real>& a, const MovingBounds<Real>& b) {
  const auto isNotAbove = (a.start.low <= b.start.high) | (a.end.low <= b.end.high),
             isNotBelow = (b.start.low <= a.start.high) | (b.end.low <= a.end.high);
  return (bitsOfFour(isNotAbove & isNotBelow) & 7u) == 7u;
}
// Around all of the way: what overlaps this may meet it at whatever times.
template <class Real>
INLINE MovingBounds<Real> atAnyTime(const MovingBounds<Real>& box) {
  const Bounds<Real> all = joined(box.start, box.end);
  return {all, all};
}

// Four boxes by axis; at the beginning nothing overlaps them.
template <class Real>
struct FourBounds {
  static constexpr Real FAR = std::numeric_limits<Real>::max();
  std::array<Four<Real>, 3> low{Four<Real>{} + FAR, Four<Real>{} + FAR, Four<Real>{} + FAR},
      high{Four<Real>{} - FAR, Four<Real>{} - FAR, Four<Real>{} - FAR};

  void set(std::size_t k, const Bounds<Real>& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis][k] = box.low[axis];
      high[axis][k] = box.high[axis];
    }
  }
  [[nodiscard]] INLINE Bounds<Real> at(std::size_t k) const {
    return {Four<Real>{low[0][k], low[1][k], low[2][k], 0},
            Four<Real>{high[0][k], high[1][k], high[2][k], 0}};
  }
  [[nodiscard]] INLINE Bounds<Real> all() const { return joined(joined(at(0), at(1)), joined(at(2), at(3))); }
};
// Which of the four overlap a box: lanes that are not 0.
template <class Real>
INLINE auto overlap(const FourBounds<Real>& four, const Bounds<Real>& box) {
  return ((four.low[0] <= box.high[0]) & (four.low[1] <= box.high[1]) & (four.low[2] <= box.high[2])) &
         ((four.high[0] >= box.low[0]) & (four.high[1] >= box.low[1]) & (four.high[2] >= box.low[2]));
}

template <class Real>
struct FourMovingBounds {
  FourBounds<Real> start, end;

  void set(std::size_t k, const MovingBounds<Real>& box) {
    start.set(k, box.start);
    end.set(k, box.end);
  }
};
template <class Real>
INLINE auto overlap(const FourMovingBounds<Real>& four, const MovingBounds<Real>& box) {
  const auto along = [&](std::size_t axis) __attribute__((always_inline)) {
    return ((four.start.low[axis] <= box.start.high[axis]) | (four.end.low[axis] <= box.end.high[axis])) &
           ((four.start.high[axis] >= box.start.low[axis]) | (four.end.high[axis] >= box.end.low[axis]));
  };
  return along(0) & along(1) & along(2);
}

}  // namespace clothsim::cpu
