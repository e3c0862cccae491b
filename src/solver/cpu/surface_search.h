// The search for parts of the surface that are near each other; the twin of
// shaders/sim/surface/walk.glsl.
#pragma once

#include <algorithm>
#include <array>
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
  std::vector<Bounds<Real>> particles;
  std::vector<Bounds<Real>> triangles;  // and room for the tree over them

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
    const Bounds<Real>& second = triangles[parts.second];
    if (!parts.areSides) return overlap(particles[i], second);
    const Bounds<Real> side = joined(particles[i], particles[j]);
    return overlap(side, second) && overlap(side, joined(particles[k], particles[l]));
  }
};

template <class Real>
struct SurfaceSearch {
  const ClothSurface<Real>& surface;
  const std::vector<Bounds<Real>>& tree;

  // Makes the tree over the boxes of the triangles, which are its first.
  static void growTree(const ClothSurface<Real>& surface, std::vector<Bounds<Real>>& tree) {
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
  void walk(std::size_t bottom, std::uint32_t place, const Bounds<Real>& own, Visit visit) const {
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
  // a particle that is in both, where the boxes meet.
  template <class Visit>
  void forEachPair(std::uint32_t triangle, const SurfaceBoxes<Real>& boxes, Visit visit) const {
    forEachNeighbor(triangle, [&](std::uint32_t neighbor) { forEachPair(triangle, neighbor, boxes, visit); });
  }

  // The same for triangles that have a box together, BOX_CHILDREN or fewer: they go through the tree as one.
  // end(triangle) comes behind a triangle's pairs.
  template <class Visit, class End>
  void forEachPairOfGroup(std::uint32_t group, const SurfaceBoxes<Real>& boxes,
                          std::vector<std::uint32_t>& nearGroups, Visit visit, End end) const {
    const std::vector<std::uint32_t>& first = surface.firstBoxes;
    nearGroups.clear();
    if (first.size() > 2)
      walk(1, group, tree[first[1] + group], [&](std::uint32_t near) { nearGroups.push_back(near); });
    const std::uint32_t own = BOX_CHILDREN * group, behind = std::min(own + BOX_CHILDREN, first[1]);
    for (std::uint32_t triangle = own; triangle < behind; ++triangle) {
      const Bounds<Real> box = tree[triangle];
      for (const std::uint32_t near : nearGroups) {
        const std::uint32_t last = std::min(BOX_CHILDREN * (near + 1), first[1]);
        for (std::uint32_t i = std::max(BOX_CHILDREN * near, triangle + 1); i < last; ++i)
          if (overlap(box, tree[i])) forEachPair(triangle, i, boxes, visit);
      }
      end(triangle);
    }
  }

 private:
  template <class Visit>
  void forEachPair(std::uint32_t triangle, std::uint32_t neighbor, const SurfaceBoxes<Real>& boxes,
                   Visit& visit) const {
    const auto look = [&](const Parts& parts) {
      if (boxes.meet(parts)) visit(parts);
    };
    forEachCorner(triangle, neighbor, look);
    forEachCorner(neighbor, triangle, look);
    forEachSide(triangle, neighbor, look);
  }
  template <class Visit>
  void forEachCorner(std::uint32_t from, std::uint32_t to, Visit& visit) const {
    const auto mine = cornersOf(surface.triangles[from]), theirs = cornersOf(surface.triangles[to]);
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t i = mine[k];
      if ((surface.triangles[from].owned >> k & 1u) == 0) continue;
      if (i == theirs[0] || i == theirs[1] || i == theirs[2]) continue;
      visit(Parts{{i, theirs[0], theirs[1], theirs[2]}, from, to, false, k, 0});
    }
  }
  template <class Visit>
  void forEachSide(std::uint32_t from, std::uint32_t to, Visit& visit) const {
    const auto mine = cornersOf(surface.triangles[from]), theirs = cornersOf(surface.triangles[to]);
    for (std::uint8_t k = 0; k < 3; ++k) {
      if ((surface.triangles[from].owned >> (OWNED_SIDE + k) & 1u) == 0) continue;
      const std::uint32_t p = mine[k], q = mine[(k + 1) % 3];
      for (std::uint8_t l = 0; l < 3; ++l) {
        if ((surface.triangles[to].owned >> (OWNED_SIDE + l) & 1u) == 0) continue;
        const std::uint32_t a = theirs[l], b = theirs[(l + 1) % 3];
        if (a != p && a != q && b != p && b != q) visit(Parts{{p, q, a, b}, from, to, true, k, l});
      }
    }
  }
};

}  // namespace clothsim::cpu
