// Which parts of the surface are near each other: lists that are kept while the cloth moves little (Verlet,
// "Computer experiments on classical fluids I", 1967). The GPU looks for them in every step and finds the
// same, in the same order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/cpu/flat_blocks.h"
#include "solver/cpu/surface_search.h"

namespace clothsim::cpu {

template <class Real>
class NearParts {
 public:
  // Before the first update() of a surface.
  void clear() { covers_.particles.clear(); }
  // Lists the pairs of parts whose boxes meet, and those that are nearly so near, but not those where the
  // cloth is surely flat. The list is made again when some of these are no longer flat, and when a particle's
  // box has left the one that it was made with, which is larger by `more` to each side [m]. `origin`: where
  // the cloth is as a whole, at the start and at the end of its motion; that it moves as one is no reason to.
  // `around`: how far boxes reach around their particles [m]. Says whether it was made.
  bool update(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes, Vec3<Real> origin,
              Vec3<Real> originAtEnd, Real around, Real more, const FlatBlocks<Real>& flat);
  // Lists those where the cloth is surely flat, too, if update() has made new lists since.
  void listFlat(const ClothSurface<Real>& surface);
  // visit(parts, apart) for those of a triangle in the order of the tree, until it says no: all whose boxes
  // meet where the cloth is not flat, and some others. Those are left out of which the motion surely leaves
  // more than `reach` [m]. visit() may set `apart` to apartIn() of what it leaves; until then it is negative.
  template <class Visit>
  void forEachPair(const ClothSurface<Real>& surface, std::uint32_t triangle, Real reach, Visit visit) {
    forEachIn(near_, surface, triangle, reach, visit,
              [&](const Parts& parts) { return !isLeftOut(surface, parts); });
  }
  // The same for the others, which listFlat() has listed.
  template <class Visit>
  void forEachFlatPair(const ClothSurface<Real>& surface, std::uint32_t triangle, Real reach, Visit visit) {
    forEachIn(flat_, surface, triangle, reach, visit,
              [&](const Parts& parts) { return isLeftOut(surface, parts); });
  }
  // Of parts of which this motion surely leaves so much distance [m]: a bound for as long as the list is
  // kept. Any motion leaves at least the bound less what both triangles have drifted by then.
  [[nodiscard]] Real apartIn(const Parts& parts, Real left) const {
    return left - (drifts_[parts.first] + drifts_[parts.second]);
  }

  static constexpr std::uint32_t TRIANGLES = 64;        // that a thread takes at once
  static constexpr std::size_t MOST = 128 * TRIANGLES;  // pairs that are listed for them

 private:
  // The other triangle of a pair of parts, and their apartIn(): all that is read of pairs that are left out.
  struct Apart {
    std::uint32_t other;
    Real distance;
  };
  struct List {
    std::vector<std::vector<Parts>> parts;  // of TRIANGLES each
    std::vector<std::vector<Apart>> apart;  // as many
    std::vector<std::uint32_t> ends;        // of a triangle's in them
    // Where a list would take too much memory, it is not used, and parts are looked for each time.
    std::vector<std::uint8_t> isTooLong;
  };

  [[nodiscard]] bool covers(const std::vector<MovingBounds<Real>>& particles, Four<Real> shift,
                            Four<Real> shiftAtEnd) const;
  [[nodiscard]] bool areStillFlat(const FlatBlocks<Real>& flat) const;
  void findDrifts(const ClothSurface<Real>& surface, const std::vector<MovingBounds<Real>>& particles,
                  Four<Real> shift, Four<Real> shiftAtEnd, Real around);
  void makeCovers(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes, Real more);
  // Lists the pairs of triangles that belongs(triangle, other).
  template <class Belongs>
  void makeList(const ClothSurface<Real>& surface, List& list, Belongs belongs) const;
  [[nodiscard]] bool isLeftOut(const ClothSurface<Real>& surface, std::uint32_t triangle,
                               std::uint32_t other) const {
    return FlatBlocks<Real>::areFlatIn(surface, leftOut_, triangle, other);
  }
  // Of two triangles the first looks for the parts of both, whichever of them a part is of.
  [[nodiscard]] bool isLeftOut(const ClothSurface<Real>& surface, const Parts& parts) const {
    return isLeftOut(surface, std::min(parts.first, parts.second), std::max(parts.first, parts.second));
  }
  template <class Visit, class Belongs>
  void forEachIn(List& list, const ClothSurface<Real>& surface, std::uint32_t triangle, Real reach,
                 Visit& visit, Belongs belongs) {
    const std::uint32_t chunk = triangle / TRIANGLES;
    if (list.isTooLong[chunk] != 0) {
      bool goesOn = true;
      Real notKept = 0;
      SurfaceSearch<Real>{surface, covers_.triangles}.forEachPair(triangle, covers_, [&](const Parts& parts) {
        goesOn = goesOn && (!belongs(parts) || visit(parts, notKept));
      });
      return;
    }
    const Real far = reach + drifts_[triangle];
    const Parts* parts = list.parts[chunk].data();
    Apart* apart = list.apart[chunk].data();
    for (std::uint32_t n = triangle % TRIANGLES == 0 ? 0 : list.ends[triangle - 1]; n < list.ends[triangle];
         ++n)
      if (!(far + drifts_[apart[n].other] < apart[n].distance) && !visit(parts[n], apart[n].distance)) return;
  }

  SurfaceBoxes<Real> covers_;                     // its triangles are those of a tree
  std::vector<FourMovingBounds<Real>> children_;  // triangles, by their box in the tree
  Vec3<Real> origin_{}, originAtEnd_{};           // when they were made
  // How much a triangle's drift since then may take from the distances that a motion leaves [m]: its corners
  // start elsewhere, and the difference of their starts and ends is another one.
  std::vector<Real> drifts_;
  std::vector<Real> particleDrifts_;   // scratch
  std::vector<std::uint8_t> leftOut_;  // blocks that were surely flat then
  List near_, flat_;
  bool hasFlat_ = false;  // flat_ is of these covers
};

extern template class NearParts<float>;
extern template class NearParts<double>;

}  // namespace clothsim::cpu
