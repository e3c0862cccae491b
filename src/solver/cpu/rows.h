// What the passes of the CPU backend share: stretches of a grid row.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/vec.h"
#include "solver/cpu/vector_clones.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

// A stretch of particles [begin, end) of one row, as indices into the arrays.
struct Stretch {
  std::ptrdiff_t begin, end;
};

// Those particles of the row whose neighbours from `firstOffset` to `lastOffset` columns away are on the
// grid.
template <class Real>
Stretch stretch(const StepParams<Real>& step, int row, int firstOffset = 0, int lastOffset = 0) {
  const auto columns = static_cast<std::ptrdiff_t>(step.columns);
  const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(step.firstParticle) + row * columns;
  return {start + std::max(0, -firstOffset), start + columns - std::max(0, lastOffset)};
}

template <class Real>
std::ptrdiff_t indexOffset(const StepParams<Real>& step, int columns, int rows) {
  return columns + rows * static_cast<std::ptrdiff_t>(step.columns);
}

template <class Real>
INLINE Vec3<Real> load(const Real* x, const Real* y, const Real* z, std::ptrdiff_t i) {
  return {x[i], y[i], z[i]};
}

}  // namespace clothsim::cpu
