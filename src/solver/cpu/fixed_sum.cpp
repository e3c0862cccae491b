#include "solver/cpu/fixed_sum.h"

#include <algorithm>
#include <array>

#include "core/thread_team.h"
#include "shared/implicit.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {
namespace {

constexpr std::size_t BLOCK = SUM_BLOCK;
// How many blocks a thread takes at once.
constexpr std::uint32_t BLOCKS_AT_ONCE = 4;

template <class Real>
INLINE Real addLanes(std::array<Real, SUM_LANES>& lanes) {
  for (std::size_t stride = SUM_LANES / 2; stride > 0; stride /= 2)
    for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = lanes[lane] + lanes[lane + stride];
  return lanes[0];
}

// valueAt(first) + ... + valueAt(end - 1), of a block.
template <class Real, class ValueAt>
INLINE Real sumBlock(std::ptrdiff_t first, std::ptrdiff_t end, ValueAt valueAt) {
  std::array<Real, SUM_LANES> lanes{};
  for (; first + SUM_LANES <= end; first += SUM_LANES)
#pragma GCC ivdep
    for (std::ptrdiff_t lane = 0; lane < SUM_LANES; ++lane)
      lanes[static_cast<std::size_t>(lane)] += valueAt(first + lane);
  for (std::ptrdiff_t lane = 0; first + lane < end; ++lane)
    lanes[static_cast<std::size_t>(lane)] += valueAt(first + lane);
  return addLanes(lanes);
}

template <class Real>
INLINE Real dotBlock(const Arrays<const Real>& a, const Arrays<const Real>& b, std::ptrdiff_t first,
                     std::ptrdiff_t end) {
  return sumBlock<Real>(
      first, end, [=](std::ptrdiff_t i) __attribute__((always_inline)) { return dot(at(a, i), at(b, i)); });
}
VECTOR_CLONES(float, dotOfBlock,
              (const Arrays<const float>& a, const Arrays<const float>& b, std::ptrdiff_t first,
               std::ptrdiff_t end),
              (a, b, first, end), dotBlock(a, b, first, end))
double dotOfBlock(const Arrays<const double>& a, const Arrays<const double>& b, std::ptrdiff_t first,
                  std::ptrdiff_t end) {
  return dotBlock(a, b, first, end);
}

// Of the sums of all blocks; sumOf(first, end) is that of one.
template <class Real, class SumOf>
Real sumBlocks(std::size_t count, std::vector<Real>& partials, SumOf sumOf) {
  const std::size_t blocks = (count + BLOCK - 1) / BLOCK;
  partials.resize(blocks);
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(blocks), BLOCKS_AT_ONCE, [&](std::uint32_t block) {
        partials[block] = sumOf(static_cast<std::ptrdiff_t>(block * BLOCK),
                                static_cast<std::ptrdiff_t>(std::min(count, (block + 1) * BLOCK)));
      });
  return sumBlock<Real>(0, static_cast<std::ptrdiff_t>(blocks),
                        [&](std::ptrdiff_t block) { return partials.data()[block]; });
}

}  // namespace

template <class Real>
Real fixedSum(const Components<Real>& a, const Components<Real>& b, std::vector<Real>& partials) {
  const Arrays<const Real> left = arraysOf(a), right = arraysOf(b);
  return sumBlocks(a.x.size(), partials, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
    return dotOfBlock(left, right, first, end);
  });
}

template <class Real>
Real fixedSum(const std::vector<Real>& a, std::vector<Real>& partials) {
  return sumBlocks(a.size(), partials, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
    return sumBlock<Real>(first, end, [&](std::ptrdiff_t i) { return a.data()[i]; });
  });
}

#define INSTANTIATE(Real)                                                                       \
  template Real fixedSum(const Components<Real>&, const Components<Real>&, std::vector<Real>&); \
  template Real fixedSum(const std::vector<Real>&, std::vector<Real>&);
INSTANTIATE(float)
INSTANTIATE(double)

}  // namespace clothsim::cpu
