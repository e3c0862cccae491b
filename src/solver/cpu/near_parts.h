// Which parts of the surface are near each other: a list that is kept while the cloth moves little (Verlet,
// "Computer experiments on classical fluids I", 1967). The GPU looks for them in every step and finds the
// same, in the same order.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/cpu/surface_search.h"

namespace clothsim::cpu {

template <class Real>
class NearParts {
 public:
  // Before the first update() of a surface.
  void clear() { covers_.particles.clear(); }
  // Lists the pairs of parts whose boxes meet, and those that are nearly so near: the list is made again when
  // a particle's box has left the one that it was made with, which is larger by `more` to each side [m].
  // `origin`: where the cloth is as a whole; that it moves as one is no reason to. Says whether it was made.
  bool update(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes, Vec3<Real> origin,
              Real more);
  // visit(parts) for those of a triangle in the order of the tree, until it says no. Among them are all whose
  // boxes meet.
  template <class Visit>
  void forEachPair(const ClothSurface<Real>& surface, std::uint32_t triangle, Visit visit) const {
    const std::uint32_t chunk = triangle / TRIANGLES;
    if (isTooLong_[chunk] != 0) {
      bool goesOn = true;
      SurfaceSearch<Real>{surface, covers_.triangles}.forEachPair(
          triangle, covers_, [&](const Parts& parts) { goesOn = goesOn && visit(parts); });
      return;
    }
    const std::vector<Parts>& parts = parts_[chunk];
    for (std::uint32_t n = triangle % TRIANGLES == 0 ? 0 : ends_[triangle - 1]; n < ends_[triangle]; ++n)
      if (!visit(parts[n])) return;
  }

  static constexpr std::uint32_t TRIANGLES = 64;        // that a thread takes at once
  static constexpr std::size_t MOST = 128 * TRIANGLES;  // pairs that are listed for them

 private:
  [[nodiscard]] bool covers(const std::vector<Bounds<Real>>& particles, Four<Real> shift) const;
  void makeCovers(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes, Real more);

  SurfaceBoxes<Real> covers_;              // its triangles are those of a tree
  Vec3<Real> origin_{};                    // when they were made
  std::vector<std::vector<Parts>> parts_;  // of TRIANGLES each
  std::vector<std::uint32_t> ends_;        // of a triangle's in them
  // Where a list would take too much memory, it is not used, and parts are looked for each time.
  std::vector<std::uint8_t> isTooLong_;
};

extern template class NearParts<float>;
extern template class NearParts<double>;

}  // namespace clothsim::cpu
