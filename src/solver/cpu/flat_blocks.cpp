#include "solver/cpu/flat_blocks.h"

#include "core/thread_team.h"
#include "shared/implicit.h"

namespace clothsim::cpu {
namespace {

constexpr std::uint32_t FLAT_BLOCKS_AT_ONCE = 32;

template <class Real>
Bounds<Real> nothing() {
  const Real most = static_cast<Real>(LARGE_SQUARE);
  return {Four<Real>{most, most, most, most}, Four<Real>{-most, -most, -most, -most}};
}

}  // namespace

template <class Real>
auto FlatBlocks<Real>::sidesOf(const SurfaceBlock& block, const Components<Real>& starts,
                               const Components<Real>& ends) -> Sides {
  Sides sides{nothing<Real>(), nothing<Real>()};
  const Real perAlong = block.perAlong, perDown = block.perDown;
  for (const Components<Real>* places : {&starts, &ends}) {
    const Arrays<const Real> x = arraysOf(*places);
    for (std::uint32_t row = 0; row < block.height; ++row)
      for (std::uint32_t column = 0; column < block.width; ++column) {
        const auto i = static_cast<std::ptrdiff_t>(block.first + row * block.stride + column);
        const Four<Real> place = fourAt(x, i);
        if (column + 1 < block.width) {
          const Four<Real> side = perAlong * (fourAt(x, i + 1) - place);
          sides.along = cpu::joined(sides.along, Bounds<Real>{side, side});
        }
        if (row + 1 < block.height) {
          const Four<Real> side =
              perDown * (fourAt(x, i + static_cast<std::ptrdiff_t>(block.stride)) - place);
          sides.down = cpu::joined(sides.down, Bounds<Real>{side, side});
        }
      }
  }
  return sides;
}

template <class Real>
bool FlatBlocks<Real>::isFlat(const SurfaceBlock& block, const Sides& sides, Real reach) {
  const Real stretch = SurfaceLaws<Real>::leastStretch(threeOf(sides.along.low), threeOf(sides.along.high),
                                                       threeOf(sides.down.low), threeOf(sides.down.high));
  return reach < stretch * Real(block.apart);
}

template <class Real>
auto FlatBlocks<Real>::aroundOf(const std::vector<SurfaceBlock>& blocks, std::uint32_t number) const
    -> Sides {
  const SurfaceBlock& block = blocks[number];
  Sides around = sides_[number];
  for (std::uint32_t row = block.row == 0 ? 0 : block.row - 1; row < std::min(block.row + 2, block.rows);
       ++row)
    for (std::uint32_t column = block.column == 0 ? 0 : block.column - 1;
         column < std::min(block.column + 2, block.columns); ++column)
      around = joined(around, sides_[block.firstOfGrid + row * block.columns + column]);
  return around;
}

template <class Real>
void FlatBlocks<Real>::update(const ClothSurface<Real>& surface, const Components<Real>& starts,
                              const Components<Real>& ends, Real reach, Real sureReach) {
  const std::vector<SurfaceBlock>& blocks = surface.blocks;
  const auto count = static_cast<std::uint32_t>(blocks.size());
  sides_.resize(count);
  isFlat_.resize(count);
  isSurelyFlat_.resize(count);
  isAllFlat_ = false;
  ThreadTeam::shared().forEach(0, count, FLAT_BLOCKS_AT_ONCE,
                               [&](std::uint32_t i) { sides_[i] = sidesOf(blocks[i], starts, ends); });
  ThreadTeam::shared().forEach(0, count, FLAT_BLOCKS_AT_ONCE, [&](std::uint32_t i) {
    const Sides around = aroundOf(blocks, i);
    isFlat_[i] = isFlat(blocks[i], around, reach) ? 1 : 0;
    isSurelyFlat_[i] = isFlat(blocks[i], around, sureReach) ? 1 : 0;
  });
  if (!surface.isOneGrid) return;
  Sides all = sides_[0];
  for (const Sides& sides : sides_) all = joined(all, sides);
  isAllFlat_ = isFlat(blocks[0], all, reach);
}

template class FlatBlocks<float>;
template class FlatBlocks<double>;

}  // namespace clothsim::cpu
