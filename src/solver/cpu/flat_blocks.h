// Where the cloth is too flat for parts of it to meet (leastStretch() in shaders/shared/surface_laws.h); the
// twin of shaders/sim/surface/flat_*.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/cpu/surface_search.h"

namespace clothsim::cpu {

template <class Real>
class FlatBlocks {
 public:
  // While the cloth moves from `starts` to `ends`: where are parts that have no particle in common farther
  // apart than `reach`? And where for sure: farther than `sureReach`, the larger one.
  void update(const ClothSurface<Real>& surface, const Components<Real>& starts, const Components<Real>& ends,
              Real reach, Real sureReach);
  // The same block, or neighbours, which are flat together.
  [[nodiscard]] bool areFlat(const ClothSurface<Real>& surface, std::uint32_t triangle,
                             std::uint32_t other) const {
    return areFlatIn(surface, isFlat_, triangle, other);
  }
  // The same, with what is said to be flat, by block: 0 or not.
  [[nodiscard]] static bool areFlatIn(const ClothSurface<Real>& surface,
                                      const std::vector<std::uint8_t>& isFlat, std::uint32_t triangle,
                                      std::uint32_t other) {
    const std::uint32_t block = surface.triangles[triangle].block;
    return block != NO_BLOCK && isFlat[block] != 0 &&
           areNeighbors(surface.blocks, block, surface.triangles[other].block);
  }
  [[nodiscard]] const std::vector<std::uint8_t>& isFlat() const { return isFlat_; }
  [[nodiscard]] const std::vector<std::uint8_t>& isSurelyFlat() const { return isSurelyFlat_; }
  // The cloth is one grid, which is flat as a whole.
  [[nodiscard]] bool isAllFlat() const { return isAllFlat_; }

 private:
  // Of the sides of a block over their distance in the grid: those along rows, and along columns.
  struct Sides {
    Bounds<Real> along, down;
  };
  static bool areNeighbors(const std::vector<SurfaceBlock>& blocks, std::uint32_t block,
                           std::uint32_t other) {
    if (other == NO_BLOCK || blocks[other].firstOfGrid != blocks[block].firstOfGrid) return false;
    const SurfaceBlock &a = blocks[block], &b = blocks[other];
    return a.column <= b.column + 1 && b.column <= a.column + 1 && a.row <= b.row + 1 && b.row <= a.row + 1;
  }
  static Sides joined(const Sides& a, const Sides& b) {
    return {cpu::joined(a.along, b.along), cpu::joined(a.down, b.down)};
  }
  static Sides sidesOf(const SurfaceBlock& block, const Components<Real>& starts,
                       const Components<Real>& ends);
  static bool isFlat(const SurfaceBlock& block, const Sides& sides, Real reach);
  [[nodiscard]] Sides aroundOf(const std::vector<SurfaceBlock>& blocks, std::uint32_t block) const;

  std::vector<Sides> sides_;
  std::vector<std::uint8_t> isFlat_, isSurelyFlat_;
  bool isAllFlat_ = false;
};

extern template class FlatBlocks<float>;
extern template class FlatBlocks<double>;

}  // namespace clothsim::cpu
