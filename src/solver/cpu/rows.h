// What the passes of the CPU backend share: stretches of a grid row, and what of it is cut.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "cloth/cloth.h"
#include "core/vec.h"
#include "core/vector_clones.h"
#include "solver/step_params.h"

namespace clothsim::cpu {

// How a mesh, a grid of one row, is shared by threads: so many particles are a row for the passes.
inline constexpr int MESH_ROW = 256;
[[nodiscard]] inline int rowsOf(const Piece& piece) {
  return piece.isMesh ? (piece.columns + MESH_ROW - 1) / MESH_ROW : piece.rows;
}

// A stretch of particles [begin, end) of one row, as indices into the arrays.
struct Range {
  std::ptrdiff_t begin, end;
};

// Those particles of the row whose neighbours from `firstOffset` to `lastOffset` columns away are on the
// grid.
template <class Real>
Range rangeOf(const StepParams<Real>& step, int row, int firstOffset = 0, int lastOffset = 0) {
  const auto columns = static_cast<std::ptrdiff_t>(step.columns);
  if (step.isMesh != 0) {  // one long row, in stretches of MESH_ROW particles
    const auto first = static_cast<std::ptrdiff_t>(step.firstParticle);
    return {first + std::ptrdiff_t{MESH_ROW} * row,
            first + std::min(columns, std::ptrdiff_t{MESH_ROW} * (row + 1))};
  }
  const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(step.firstParticle) + row * columns;
  return {start + std::max(0, -firstOffset), start + columns - std::max(0, lastOffset)};
}

// body(particles, isEnd) for all of a row, or, with its ends apart, for its first particle, those inside, and
// its last one. A loop: what is inlined in the body is compiled once for all of them.
template <class Body>
INLINE void forEachPart(Range all, bool endsApart, Body body) {
  const std::ptrdiff_t first = endsApart ? all.begin + 1 : all.end,
                       last = endsApart ? std::max(first, all.end - 1) : all.end;
  for (Range part{all.begin, first}; part.begin < all.end;
       part = {part.end, part.end < last ? last : all.end})
    body(part, endsApart && (part.begin == all.begin || part.begin == last));
}

template <class Real>
std::ptrdiff_t indexOffset(const StepParams<Real>& step, int columns, int rows) {
  return columns + rows * static_cast<std::ptrdiff_t>(step.columns);
}

// The slots before that of springs to second neighbours, which a fabric does not have.
inline constexpr std::size_t NEIGHBOUR_SLOTS = toSecondLeft;
template <class Real>
bool hasSecondNeighbours(const StepParams<Real>& step) {
  return step.enabledSlots >> NEIGHBOUR_SLOTS != 0;
}

template <class Number>
INLINE Number larger(Number a, Number b) {
  return a < b ? b : a;
}

// Floats in the widest vector register.
inline constexpr std::ptrdiff_t SIXTEEN = 16;
// work(begin, end) for sixteen particles each, so that a loop over them needs no remainder: the last ones may
// be worked on twice, which must do no harm.
template <class Work>
INLINE void forEachSixteen(Range particles, Work work) {
  const std::ptrdiff_t last = particles.end - SIXTEEN;
  if (last < particles.begin) return work(particles.begin, particles.end);
  for (std::ptrdiff_t begin = particles.begin; begin < last; begin += SIXTEEN) work(begin, begin + SIXTEEN);
  work(last, last + SIXTEEN);
}
// The largest of what was gathered of every sixteenth: that keeps a vector, which is reduced once.
template <class Number>
INLINE Number largestOf(const Number (&lanes)[SIXTEEN]) {
  Number largest = lanes[0];
  for (const Number lane : lanes) largest = larger(largest, lane);
  return largest;
}

template <class Real>
INLINE Vec3<Real> load(const Real* x, const Real* y, const Real* z, std::ptrdiff_t i) {
  return {x[i], y[i], z[i]};
}

// Whether a cut mask (cloth/cuts.h) says that this spring or triangle is gone; without cuts none is.
template <bool hasCuts>
INLINE bool isCutAt([[maybe_unused]] const std::uint32_t* cutMasks, [[maybe_unused]] std::ptrdiff_t i,
                    [[maybe_unused]] std::uint32_t bit) {
  if constexpr (hasCuts) return (cutMasks[i] >> bit & 1u) != 0;
  return false;
}

}  // namespace clothsim::cpu
