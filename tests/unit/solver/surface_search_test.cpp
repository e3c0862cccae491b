// Boxes at the start and at the end of motions: nothing that comes near is left out
// (solver/cpu/surface_search.h).
#include "solver/cpu/surface_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/vec.h"
#include "solver/cpu/bounds.h"
#include "solver/cpu/surface_laws.h"
#include "solver/surface.h"

namespace clothsim {
namespace {

using Boxes = cpu::SurfaceBoxes<double>;
using Search = cpu::SurfaceSearch<double>;
using Laws = cpu::SurfaceLaws<double>;
using PartNames = std::set<std::array<std::uint32_t, 4>>;

// Triangles each of which looks for all of its corners and sides.
ClothSurface<double> surfaceOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  ClothSurface<double> surface;
  for (const auto& [a, b, c] : triangles)
    surface.triangles.push_back({a, b, c, 63u, NO_PARTICLE, NO_PARTICLE, NO_PARTICLE, NO_BLOCK});
  surface.firstBoxes = {0};
  for (auto boxes = static_cast<std::uint32_t>(triangles.size()); boxes > 0;
       boxes = boxes == 1 ? 0 : (boxes + BOX_CHILDREN - 1) / BOX_CHILDREN)
    surface.firstBoxes.push_back(surface.firstBoxes.back() + boxes);
  return surface;
}

Boxes boxesAround(const ClothSurface<double>& surface, const std::vector<Vec3d>& starts,
                  const std::vector<Vec3d>& ends, double around) {
  Boxes boxes;
  const cpu::Four<double> r{around, around, around, 0};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const cpu::Four<double> a = cpu::fourOf(starts[i]), b = cpu::fourOf(ends[i]);
    boxes.particles.push_back({{a - r, a + r}, {b - r, b + r}});
  }
  boxes.joinTriangles(surface);
  Search::growTree(surface, boxes.triangles);
  return boxes;
}
void forgetTimes(Boxes& boxes) {
  for (auto* all : {&boxes.particles, &boxes.triangles})
    for (cpu::MovingBounds<double>& box : *all) box = cpu::atAnyTime(box);
}

PartNames found(const ClothSurface<double>& surface, const Boxes& boxes) {
  PartNames names;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
    Search{surface, boxes.triangles}.forEachPair(
        i, boxes, [&](const cpu::Parts& parts) { names.insert(parts.particles); });
  return names;
}

Vec3d between(Vec3d from, Vec3d to, double time) { return from + time * (to - from); }

// Those of two triangles, 0 1 2 and 3 4 5, that come nearer than `reach` while each is where it is at its
// time.
void addNearParts(const std::vector<Vec3d>& starts, const std::vector<Vec3d>& ends, double firstTime,
                  double secondTime, double reach, PartNames& names) {
  const auto look = [&](bool areSides, std::array<std::uint32_t, 4> parts) {
    Vec3d x[4];
    for (std::size_t k = 0; k < 4; ++k)
      x[k] = between(starts[parts[k]], ends[parts[k]], parts[k] < 3 ? firstTime : secondTime);
    const Vec3d way = Laws::nearestParts(areSides, x[0], x[1], x[2], x[3]).way;
    if (dot(way, way) < reach * reach) names.insert(parts);
  };
  for (std::uint32_t k = 0; k < 3; ++k) {
    look(false, {k, 3, 4, 5});
    look(false, {3 + k, 0, 1, 2});
    for (std::uint32_t l = 0; l < 3; ++l) look(true, {k, (k + 1) % 3, 3 + l, 3 + (l + 1) % 3});
  }
}

TEST(SurfaceSearch, FindsAllPartsThatComeNear) {
  const ClothSurface<double> surface = surfaceOf({{0, 1, 2}, {3, 4, 5}});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr double around = 0.1;
  constexpr int times = 8;
  std::size_t near = 0, all = 0, atAnyTime = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto anywhere = [&](double size) { return size * Vec3d{any(random), any(random), any(random)}; };
    std::vector<Vec3d> starts, ends;
    const Vec3d motion = anywhere(4);
    for (int triangle = 0; triangle < 2; ++triangle) {
      const Vec3d place = anywhere(2), own = motion + anywhere(trial % 3);
      for (int k = 0; k < 3; ++k) {
        starts.push_back(place + anywhere(0.7));
        ends.push_back(starts.back() + own + anywhere(0.3));
      }
    }
    PartNames together, anytime;
    for (int i = 0; i <= times; ++i)
      for (int j = 0; j <= times; ++j) {
        const double first = static_cast<double>(i) / times, second = static_cast<double>(j) / times;
        addNearParts(starts, ends, first, second, 2 * around, anytime);
        if (i == j) addNearParts(starts, ends, first, second, 2 * around, together);
      }
    Boxes boxes = boxesAround(surface, starts, ends, around);
    const PartNames seen = found(surface, boxes);
    forgetTimes(boxes);
    const PartNames seenAnytime = found(surface, boxes);
    ASSERT_TRUE(std::includes(seen.begin(), seen.end(), together.begin(), together.end())) << trial;
    ASSERT_TRUE(std::includes(seenAnytime.begin(), seenAnytime.end(), anytime.begin(), anytime.end()))
        << trial;
    ASSERT_TRUE(std::includes(seenAnytime.begin(), seenAnytime.end(), seen.begin(), seen.end())) << trial;
    near += together.size();
    all += seen.size();
    atAnyTime += seenAnytime.size();
  }
  EXPECT_GT(near, 300u) << "some parts come near";
  EXPECT_GT(atAnyTime, 2 * all) << "boxes around all of the way meet many more";
}

TEST(SurfaceSearch, FindsNoMoreInASheetThatSwingsFastThanInOneAtRest) {
  constexpr std::uint32_t n = 33;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3d> starts, ends;
  const double angle = 0.3;
  for (std::uint32_t row = 0; row < n; ++row)
    for (std::uint32_t column = 0; column < n; ++column) {
      const double x = row, z = column;
      starts.push_back({x, 0, z});
      ends.push_back({x * std::cos(angle), -x * std::sin(angle), z});  // by nine cells at its far side
      const std::uint32_t i = row * n + column;
      if (row + 1 == n || column + 1 == n) continue;
      triangles.push_back({i, i + 1, i + n});
      triangles.push_back({i + 1, i + n + 1, i + n});
    }
  const ClothSurface<double> surface = surfaceOf(triangles);
  const std::size_t atRest = found(surface, boxesAround(surface, starts, starts, 0.1)).size();
  Boxes swinging = boxesAround(surface, starts, ends, 0.1);
  EXPECT_GT(atRest, 1000u);
  EXPECT_LE(found(surface, swinging).size(), atRest);
  forgetTimes(swinging);
  EXPECT_GT(found(surface, swinging).size(), 2 * atRest) << "boxes around all of the way meet many more";
}

}  // namespace
}  // namespace clothsim
