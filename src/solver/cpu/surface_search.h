// The search for parts of the surface that are near each other; the twin of
// shaders/sim/surface/walk.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/cpu/arrays.h"
#include "solver/cpu/bounds.h"
#include "solver/cpu/surface_laws.h"
#include "solver/surface.h"

namespace clothsim::cpu {

// A corner and a triangle, or two sides.
struct Parts {
  std::array<std::uint32_t, 4> particles;
  bool areSides;
  std::uint32_t first, second;  // the triangles that they are of
  std::uint32_t k, l;           // the corner, or the sides, in them
};

[[nodiscard]] inline std::array<std::uint32_t, 3> cornersOf(const SurfaceTriangle& t) {
  return {t.cornerA, t.cornerB, t.cornerC};
}
[[nodiscard]] inline std::array<std::uint32_t, 3> acrossOf(const SurfaceTriangle& t) {
  return {t.acrossAB, t.acrossBC, t.acrossCA};
}

template <class Real>
struct SurfaceSearch {
  const ClothSurface<Real>& surface;
  const std::vector<Bounds<Real>>& boxes;          // of the tree
  const std::vector<Bounds<Real>>& particleBoxes;  // around each particle and its motion
  const Components<Real>& starts;

  // visit(triangle) for the triangles behind this one, in the order of the tree, whose boxes meet its own.
  template <class Visit>
  void forEachNeighbor(std::uint32_t triangle, Visit visit) const {
    const std::vector<std::uint32_t>& first = surface.firstBoxes;
    const std::size_t top = first.size() - 2;
    const Bounds<Real> own = boxes[triangle];
    std::size_t level = 0;
    std::uint32_t place = triangle + 1;  // within the level
    for (;;) {
      for (; place % BOX_CHILDREN == 0 && level < top; ++level) place /= BOX_CHILDREN;
      for (;; place *= BOX_CHILDREN, --level) {  // down, as long as boxes meet
        if (place >= first[level + 1] - first[level]) {
          if (level == top) return;
          place = place / BOX_CHILDREN + 1;
          ++level;
          break;
        }
        const bool meets = overlap(own, boxes[first[level] + place]);
        if (meets && level > 0) continue;
        if (meets) visit(place);
        ++place;
        break;
      }
    }
  }

  // test(parts, nearest) for the pairs of parts that this triangle finds: boxes meet, and no particle is in
  // both. test() says whether to go on.
  template <class Test>
  void forEachPair(std::uint32_t triangle, Test test) const {
    bool goesOn = true;
    forEachNeighbor(triangle, [&](std::uint32_t neighbor) {
      lookAtCorners(triangle, neighbor, goesOn, test);
      lookAtCorners(neighbor, triangle, goesOn, test);
      lookAtSides(triangle, neighbor, goesOn, test);
    });
  }

 private:
  template <class Test>
  void lookAtCorners(std::uint32_t from, std::uint32_t to, bool& goesOn, Test& test) const {
    const auto mine = cornersOf(surface.triangles[from]), theirs = cornersOf(surface.triangles[to]);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t i = mine[k];
      if ((surface.triangles[from].owned >> k & 1u) == 0) continue;
      if (i == theirs[0] || i == theirs[1] || i == theirs[2] || !overlap(particleBoxes[i], boxes[to]))
        continue;
      const auto nearest = SurfaceLaws<Real>::nearestOnTriangle(at(starts, i), at(starts, theirs[0]),
                                                                at(starts, theirs[1]), at(starts, theirs[2]));
      goesOn = goesOn && test(Parts{{i, theirs[0], theirs[1], theirs[2]}, false, from, to, k, 0}, nearest);
    }
  }
  template <class Test>
  void lookAtSides(std::uint32_t from, std::uint32_t to, bool& goesOn, Test& test) const {
    const auto mine = cornersOf(surface.triangles[from]), theirs = cornersOf(surface.triangles[to]);
    for (std::uint32_t k = 0; k < 3; ++k) {
      if ((surface.triangles[from].owned >> (OWNED_SIDE + k) & 1u) == 0) continue;
      const std::uint32_t p = mine[k], q = mine[(k + 1) % 3];
      const Bounds<Real> box = joined(particleBoxes[p], particleBoxes[q]);
      if (!overlap(box, boxes[to])) continue;
      for (std::uint32_t l = 0; l < 3; ++l) {
        if ((surface.triangles[to].owned >> (OWNED_SIDE + l) & 1u) == 0) continue;
        const std::uint32_t a = theirs[l], b = theirs[(l + 1) % 3];
        if (a == p || a == q || b == p || b == q || !overlap(box, joined(particleBoxes[a], particleBoxes[b])))
          continue;
        const auto nearest =
            SurfaceLaws<Real>::nearestOnSegments(at(starts, p), at(starts, q), at(starts, a), at(starts, b));
        goesOn = goesOn && test(Parts{{p, q, a, b}, true, from, to, k, l}, nearest);
      }
    }
  }
};

}  // namespace clothsim::cpu
