#include "measure/surface_crossings.h"

#include <algorithm>
#include <vector>

#include "solver/cpu/surface_search.h"

namespace clothsim {
namespace {

using Boxes = std::vector<cpu::Bounds<double>>;
using Search = cpu::SurfaceSearch<double, cpu::Bounds<double>>;

// The tree of boxes, without any room around its triangles.
Boxes makeBoxes(const ClothSurface<double>& surface, const Components<double>& places) {
  const cpu::Arrays<const double> x = cpu::arraysOf(places);
  Boxes boxes(surface.firstBoxes.back());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto corners = cpu::cornersOf(surface.triangles[i]);
    boxes[i] = {cpu::fourAt<double>(x, corners[0]), cpu::fourAt<double>(x, corners[0])};
    for (const std::uint32_t corner : corners) {
      const cpu::Four<double> place = cpu::fourAt<double>(x, corner);
      boxes[i] = cpu::joined(boxes[i], cpu::Bounds<double>{place, place});
    }
  }
  Search::growTree(surface, boxes);
  return boxes;
}

double volume(Vec3d a, Vec3d b, Vec3d c, Vec3d d) { return dot(cross(b - a, c - a), d - a); }

bool crosses(Vec3d p, Vec3d q, Vec3d a, Vec3d b, Vec3d c) {
  if (!(volume(a, b, c, p) * volume(a, b, c, q) < 0)) return false;
  const double first = volume(p, q, a, b), second = volume(p, q, b, c), third = volume(p, q, c, a);
  return (first > 0 && second > 0 && third > 0) || (first < 0 && second < 0 && third < 0);
}

// The sides that the first triangle looks after, with the second triangle.
std::uint64_t crossingsOf(const ClothSurface<double>& surface, std::uint32_t first, std::uint32_t second,
                          const Components<double>& x) {
  const SurfaceTriangle& own = surface.triangles[first];
  const auto mine = cpu::cornersOf(own), theirs = cpu::cornersOf(surface.triangles[second]);
  const auto myJoints = surface.jointsOf(own), theirJoints = surface.jointsOf(surface.triangles[second]);
  const auto isTheirs = [&](std::uint32_t joint) {
    return std::find(theirJoints.begin(), theirJoints.end(), joint) != theirJoints.end();
  };
  std::uint64_t count = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3, p = mine[k], q = mine[next];
    if ((own.owned >> (OWNED_SIDE + k) & 1u) == 0 || isTheirs(myJoints[k]) || isTheirs(myJoints[next]))
      continue;
    count += crosses(cpu::at(x, p), cpu::at(x, q), cpu::at(x, theirs[0]), cpu::at(x, theirs[1]),
                     cpu::at(x, theirs[2]))
                 ? 1
                 : 0;
  }
  return count;
}

}  // namespace

std::uint64_t crossingSides(const Cloth& cloth, const Scene& scene, const State& state) {
  const auto surface = makeSurface<double>(cloth, scene, state.cuts);
  Components<double> x;
  x.resize(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    cpu::put(x, static_cast<std::ptrdiff_t>(i), vectorOf(state.positions[i]));
  if (surface.triangles.empty()) return 0;
  const Boxes boxes = makeBoxes(surface, x);
  const Search search{surface, boxes};
  std::uint64_t count = 0;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
    search.forEachNeighbor(i, [&](std::uint32_t other) {
      count += crossingsOf(surface, i, other, x) + crossingsOf(surface, other, i, x);
    });
  return count;
}

}  // namespace clothsim
