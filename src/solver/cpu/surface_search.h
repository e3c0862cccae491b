// The search for parts of the surface that are near each other; the twin of
// shaders/sim/surface/walk.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/thread_team.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/bounds.h"
#include "solver/cpu/surface_laws.h"
#include "solver/surface.h"

namespace clothsim::cpu {

// A corner and a triangle, or two sides.
struct Parts {
  std::array<std::uint32_t, 4> particles;
  std::uint32_t first, second;  // the triangles that they are of
  bool areSides;
  std::uint8_t k, l;  // the corner, or the sides, in them
};

[[nodiscard]] inline std::array<std::uint32_t, 3> cornersOf(const SurfaceTriangle& t) {
  return {t.cornerA, t.cornerB, t.cornerC};
}
[[nodiscard]] inline std::array<std::uint32_t, 3> acrossOf(const SurfaceTriangle& t) {
  return {t.acrossAB, t.acrossBC, t.acrossCA};
}

inline constexpr std::uint32_t BOXES_AT_ONCE = 256;  // that a thread takes

// Boxes around the motions of particles and of triangles.
template <class Real>
struct SurfaceBoxes {
  std::vector<MovingBounds<Real>> particles;
  std::vector<MovingBounds<Real>> triangles;  // and room for the tree over them

  // Those of triangles, around those of their corners.
  void joinTriangles(const ClothSurface<Real>& surface) {
    triangles.resize(surface.firstBoxes.back());
    ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(surface.triangles.size()), BOXES_AT_ONCE,
                                 [&](std::uint32_t i) {
                                   const auto [a, b, c] = cornersOf(surface.triangles[i]);
                                   triangles[i] = joined(joined(particles[a], particles[b]), particles[c]);
                                 });
  }
  // Whether both parts are where they may meet.
  [[nodiscard]] bool meet(const Parts& parts) const {
    const auto& [i, j, k, l] = parts.particles;
    const MovingBounds<Real>& second = triangles[parts.second];
    if (!parts.areSides) return overlap(particles[i], second);
    const MovingBounds<Real> side = joined(particles[i], particles[j]);
    return overlap(side, second) && overlap(side, joined(particles[k], particles[l]));
  }
};

// Box: what the tree is made of.
template <class Real, class Box = MovingBounds<Real>>
struct SurfaceSearch {
  const ClothSurface<Real>& surface;
  const std::vector<Box>& tree;

  // Makes the tree over the boxes of the triangles, which are its first.
  static void growTree(const ClothSurface<Real>& surface, std::vector<Box>& tree) {
    const std::vector<std::uint32_t>& first = surface.firstBoxes;
    tree.resize(first.back());
    for (std::size_t level = 1; level + 1 < first.size(); ++level)
      for (std::uint32_t i = first[level]; i < first[level + 1]; ++i) {
        const std::uint32_t child = first[level - 1] + BOX_CHILDREN * (i - first[level]),
                            end = std::min(child + BOX_CHILDREN, first[level]);
        tree[i] = tree[child];
        for (std::uint32_t k = child + 1; k < end; ++k) tree[i] = joined(tree[i], tree[k]);
      }
  }

  // visit(place) for the boxes of level `bottom` from `place` on, in the order of the tree, that meet `own`.
  template <class Visit>
  void walk(std::size_t bottom, std::uint32_t place, const Box& own, Visit visit) const {
    const std::vector<std::uint32_t>& first = surface.firstBoxes;
    const std::size_t top = first.size() - 2;
    std::size_t level = bottom;
    for (;;) {
      for (; place % BOX_CHILDREN == 0 && level < top; ++level) place /= BOX_CHILDREN;
      for (;; place *= BOX_CHILDREN, --level) {  // down, as long as boxes meet
        if (place >= first[level + 1] - first[level]) {
          if (level == top) return;
          place = place / BOX_CHILDREN + 1;
          ++level;
          break;
        }
        const bool meets = overlap(own, tree[first[level] + place]);
        if (meets && level > bottom) continue;
        if (meets) visit(place);
        ++place;
        break;
      }
    }
  }

  // visit(triangle) for the triangles behind this one whose boxes meet its own.
  template <class Visit>
  void forEachNeighbor(std::uint32_t triangle, Visit visit) const {
    walk(0, triangle + 1, tree[triangle], visit);
  }

  // visit(parts) for the pairs of parts that a triangle looks for: of it and of triangles behind it, without
  // a particle that is in both or sewn to one of the other, where the boxes meet.
  template <class Visit>
  void forEachPair(std::uint32_t triangle, const SurfaceBoxes<Real>& boxes, Visit visit) const {
    const BoxedTriangle own(surface, boxes, triangle);
    forEachNeighbor(triangle, [&](std::uint32_t neighbor) {
      forEachPair(own, {surface, boxes, neighbor}, visit);
    });
  }

  // The same for triangles that have a box together, BOX_CHILDREN or fewer: they go through the tree as one.
  // `children`: of each such box the boxes of its triangles. Of the triangles behind one, those that
  // belongs(triangle, other). end(triangle) comes behind a triangle's pairs.
  template <class Belongs, class Visit, class End>
  void forEachPairOfGroup(std::uint32_t group, const SurfaceBoxes<Real>& boxes,
                          const std::vector<FourMovingBounds<Real>>& children,
                          std::vector<std::uint32_t>& nearGroups, Belongs belongs, Visit visit,
                          End end) const {
    const std::vector<std::uint32_t>& first = surface.firstBoxes;
    nearGroups.clear();
    if (first.size() > 2)
      walk(1, group, tree[first[1] + group], [&](std::uint32_t near) { nearGroups.push_back(near); });
    const std::uint32_t firstOwn = BOX_CHILDREN * group, behind = std::min(firstOwn + BOX_CHILDREN, first[1]);
    for (std::uint32_t triangle = firstOwn; triangle < behind; ++triangle) {
      const BoxedTriangle own(surface, boxes, triangle);
      for (const std::uint32_t near : nearGroups) {
        std::uint32_t meet = bitsOfFour(overlap(children[near], own.box));
        if (near == group) meet &= ~0u << (triangle - firstOwn + 1);
        for (; meet != 0; meet &= meet - 1) {
          const auto other = BOX_CHILDREN * near + static_cast<std::uint32_t>(std::countr_zero(meet));
          if (belongs(triangle, other)) forEachPair(own, {surface, boxes, other}, visit);
        }
      }
      end(triangle);
    }
  }

 private:
  struct BoxedTriangle {
    BoxedTriangle(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes, std::uint32_t triangle)
        : number(triangle),
          corners(cornersOf(surface.triangles[triangle])),
          joints(surface.jointsOf(surface.triangles[triangle])),
          ownedCorners(surface.triangles[triangle].owned & 7u),
          ownedSides(surface.triangles[triangle].owned >> OWNED_SIDE & 7u),
          box(boxes.triangles[triangle]),
          particleBoxes(boxes.particles.data()) {}
    [[nodiscard]] bool has(std::uint32_t joint) const {
      return joint == joints[0] || joint == joints[1] || joint == joints[2];
    }
    [[nodiscard]] const MovingBounds<Real>& cornerBox(std::uint32_t k) const {
      return particleBoxes[corners[k]];
    }
    [[nodiscard]] MovingBounds<Real> sideBox(std::uint32_t k) const {
      return joined(cornerBox(k), cornerBox(next(k)));
    }

    std::uint32_t number;
    std::array<std::uint32_t, 3> corners, joints;
    std::uint32_t ownedCorners, ownedSides;  // a bit each
    const MovingBounds<Real>& box;
    const MovingBounds<Real>* particleBoxes;
  };
  [[nodiscard]] static std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }
  // work(k) for the bits that are set.
  template <class Work>
  static void forEachBit(std::uint32_t bits, Work work) {
    for (; bits != 0; bits &= bits - 1) work(static_cast<std::uint8_t>(std::countr_zero(bits)));
  }

  template <class Visit>
  static void forEachPair(const BoxedTriangle& triangle, const BoxedTriangle& neighbor, Visit& visit) {
    forEachCorner(triangle, neighbor, visit);
    forEachCorner(neighbor, triangle, visit);
    forEachSide(triangle, neighbor, visit);
  }
  template <class Visit>
  static void forEachCorner(const BoxedTriangle& from, const BoxedTriangle& to, Visit& visit) {
    const std::array<std::uint32_t, 3>& t = to.corners;
    forEachBit(from.ownedCorners, [&](std::uint8_t k) {
      if (!to.has(from.joints[k]) && overlap(from.cornerBox(k), to.box))
        visit(Parts{{from.corners[k], t[0], t[1], t[2]}, from.number, to.number, false, k, 0});
    });
  }
  template <class Visit>
  static void forEachSide(const BoxedTriangle& from, const BoxedTriangle& to, Visit& visit) {
    if (to.ownedSides == 0) return;
    forEachBit(from.ownedSides, [&](std::uint8_t k) {
      const MovingBounds<Real> side = from.sideBox(k);
      if (!overlap(side, to.box)) return;
      const std::uint32_t p = from.joints[k], q = from.joints[next(k)];
      forEachBit(to.ownedSides, [&](std::uint8_t l) {
        const std::uint32_t a = to.joints[l], b = to.joints[next(l)];
        if (a != p && a != q && b != p && b != q && overlap(side, to.sideBox(l)))
          visit(Parts{{from.corners[k], from.corners[next(k)], to.corners[l], to.corners[next(l)]},
                      from.number,
                      to.number,
                      true,
                      k,
                      l});
      });
    });
  }
};

}  // namespace clothsim::cpu
