// Boxes along the axes.
#pragma once

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
template <class Real>
INLINE bool overlap(const Bounds<Real>& a, const Bounds<Real>& b) {
  const auto meet = (a.low <= b.high) & (b.low <= a.high);
  return (meet[0] & meet[1] & meet[2]) != 0;
}

}  // namespace clothsim::cpu
