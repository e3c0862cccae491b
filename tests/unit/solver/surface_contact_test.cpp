// What contact inside the implicit step works with (solver/surface.h); how layers behave:
// tests/unit/validation/layer_contact_test.cpp.
#include "solver/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/thread_team.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/near_parts.h"
#include "solver/cpu/surface_laws.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

// A sheet that stands a little aslant on the floor, and falls onto itself.
Scene fallingSheet(int points) {
  Scene scene = test::materialSheet(points, points, 0.2, 0.2, *materialPreset("cotton"));
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].rotation = {0, 0, 4};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 2;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::contact;
  scene.colliders = {Plane{.point = {0, 0, 0}, .normal = {0, 1, 0}, .friction = 0.4}};
  chooseCounts(scene);
  return scene;
}

State after(const Scene& scene, int steps) {
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(steps);
  EXPECT_GT(solver.contactCounts().pairs, 0u) << "it has fallen onto itself";
  return solver.state();
}

TEST(SurfaceContact, IsTheSameWithAnyNumberOfThreads) {
  const Scene scene = fallingSheet(13);
  const int threads = ThreadTeam::shared().threads();
  ThreadTeam::setSharedThreads(1);
  const State alone = after(scene, 45);
  ThreadTeam::setSharedThreads(3);
  const State together = after(scene, 45);
  ThreadTeam::setSharedThreads(threads);
  for (std::size_t i = 0; i < alone.positions.size(); ++i) {
    ASSERT_EQ(alone.positions[i].x, together.positions[i].x) << i;
    ASSERT_EQ(alone.positions[i].y, together.positions[i].y) << i;
    ASSERT_EQ(alone.velocities[i].z, together.velocities[i].z) << i;
  }
}

cpu::SurfaceBoxes<float> boxesAround(const ClothSurface<float>& surface, const State& state) {
  cpu::SurfaceBoxes<float> boxes;
  for (const auto& x : state.positions) {
    const cpu::Four<float> place{x.x, x.y, x.z, 0}, around = cpu::Four<float>{} + surface.around;
    const cpu::Bounds<float> box{place - around, place + around};
    boxes.particles.push_back({box, box});
  }
  boxes.joinTriangles(surface);
  return boxes;
}
cpu::FlatBlocks<float> flatBlocks(const ClothSurface<float>& surface, const State& state, float reach) {
  Components<float> places;
  places.resize(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    places.x[i] = state.positions[i].x;
    places.y[i] = state.positions[i].y;
    places.z[i] = state.positions[i].z;
  }
  cpu::FlatBlocks<float> flat;
  flat.update(surface, places, places, reach, 1.2f * reach);
  return flat;
}
constexpr float FAR = 1e3f;  // nothing is so flat that parts are farther apart [m]

// The parts of a triangle whose boxes meet, by their numbers: where the cloth is not flat, or all.
std::vector<std::uint32_t> meetingParts(const ClothSurface<float>& surface, cpu::NearParts<float>& near,
                                        std::uint32_t triangle, const cpu::SurfaceBoxes<float>& boxes,
                                        const cpu::FlatBlocks<float>* flat) {
  std::vector<std::uint32_t> found;
  near.forEachPair(surface, triangle, FAR, [&](const cpu::Parts& parts, float&) {
    const std::uint32_t other = parts.first == triangle ? parts.second : parts.first;
    if (boxes.meet(parts) && (flat == nullptr || !flat->areFlat(surface, triangle, other)))
      found.insert(found.end(), {parts.first, parts.second, parts.k, parts.l});
    return true;
  });
  return found;
}
// How many the list of flat parts has, and how many numbers those have whose boxes meet.
struct FlatParts {
  std::size_t listed = 0, meeting = 0;
};
FlatParts countFlatParts(const ClothSurface<float>& surface, cpu::NearParts<float>& near,
                         std::uint32_t triangle, const cpu::SurfaceBoxes<float>& boxes) {
  FlatParts count;
  near.forEachFlatPair(surface, triangle, FAR, [&](const cpu::Parts& parts, float&) {
    ++count.listed;
    count.meeting += boxes.meet(parts) ? 4 : 0;
    return true;
  });
  return count;
}

TEST(NearParts, AreThoseOfANewListWhileTheListIsKept) {
  const Scene scene = fallingSheet(13);
  const Cloth cloth(scene);
  const auto surface = makeSurface<float>(cloth, scene, {});
  CpuSolver<float> solver(cloth, scene);
  cpu::NearParts<float> kept;
  int made = 0;
  std::size_t parts = 0, flatParts = 0;
  solver.step(10);
  State last = solver.state();
  for (int part = 1; part <= 60; ++part) {  // of ten steps: flat at first, then it folds
    if (part % 6 == 1) {
      last = solver.state();
      solver.step(1);
    }
    const Vec3f origin{0.01f * static_cast<float>(part), 0, 0};
    State state = solver.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const Vec3d from = vectorOf(last.positions[i]), to = vectorOf(state.positions[i]);
      const Vec3f x = origin + (from + (part + 5) % 6 / 6.0 * (to - from)).cast<float>();
      state.positions[i] = {x.x, x.y, x.z, 0};
    }
    const auto boxes = boxesAround(surface, state);
    const auto flat = flatBlocks(surface, state, surface.touchingReach);
    made += kept.update(surface, boxes, origin, origin, surface.around, surface.margin, flat) ? 1 : 0;
    kept.listFlat(surface);
    cpu::NearParts<float> fresh;
    ASSERT_TRUE(fresh.update(surface, boxes, {}, {}, surface.around, 0, flatBlocks(surface, state, FAR)));
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      const auto expected = meetingParts(surface, fresh, i, boxes, &flat);
      ASSERT_EQ(meetingParts(surface, kept, i, boxes, &flat), expected) << "triangle " << i << " at " << part;
      const FlatParts leftOut = countFlatParts(surface, kept, i, boxes);
      ASSERT_EQ(meetingParts(surface, kept, i, boxes, nullptr).size() + leftOut.meeting,
                meetingParts(surface, fresh, i, boxes, nullptr).size());
      parts += expected.size();
      flatParts += leftOut.listed;
    }
  }
  EXPECT_GT(made, 3) << "the sheet moves farther than one list reaches";
  EXPECT_LT(made, 30);
  EXPECT_GT(parts, 1000u);
  EXPECT_GT(flatParts, 1000u);
}

// A list leaves out what it knows to be far apart, and nothing that has come near since.
TEST(NearParts, AreLookedAtAgainOnceTheyMayBeNear) {
  const Scene scene = fallingSheet(13);
  const Cloth cloth(scene);
  const auto surface = makeSurface<float>(cloth, scene, {});
  const State state = after(scene, 50);
  float reach = 0;
  cpu::NearParts<float> near;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> part(-1, 1);
  std::size_t visits = 0, firstVisits = 0, nearOnes = 0;
  for (int round = 0; round < 40; ++round) {
    // Particles drift, some of them farther, and the sheet as a whole.
    const float most = 0.01f * static_cast<float>(round) * surface.margin;
    const Vec3f origin{0.1f * static_cast<float>(round), 0, 0};
    State moved = state;
    for (auto& x : moved.positions) {
      const float drift = part(random) < 0.5f ? 0.1f * most : most;
      x = {x.x + origin.x + drift * part(random), x.y + drift * part(random), x.z + drift * part(random), 0};
    }
    const auto boxes = boxesAround(surface, moved);
    const bool isMade = near.update(surface, boxes, origin, origin, surface.around, surface.margin,
                                    flatBlocks(surface, moved, 1e-6f));
    EXPECT_EQ(isMade, round == 0);
    const auto distanceOf = [&](const cpu::Parts& parts) {
      Vec3f x[4];
      for (std::size_t k = 0; k < 4; ++k) x[k] = vectorOf(moved.positions[parts.particles[k]]).cast<float>();
      const Vec3f way = cpu::SurfaceLaws<float>::nearestParts(parts.areSides, x[0], x[1], x[2], x[3]).way;
      return std::sqrt(dot(way, way));
    };
    if (round == 0) {  // as far as every twentieth pair is apart at first
      std::vector<float> distances;
      for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
        near.forEachPair(surface, i, FAR, [&](const cpu::Parts& parts, float&) {
          distances.push_back(distanceOf(parts));
          return true;
        });
      std::ranges::sort(distances);
      reach = distances.at(distances.size() / 20);
    }
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      std::size_t visited = 0, found = 0, expected = 0;
      near.forEachPair(surface, i, reach, [&](const cpu::Parts& parts, float& apart) {
        const float distance = distanceOf(parts);
        ++visited;
        found += distance < reach ? 1 : 0;
        apart = near.apartIn(parts, distance);
        return true;
      });
      near.forEachPair(surface, i, FAR, [&](const cpu::Parts& parts, float&) {
        expected += distanceOf(parts) < reach ? 1 : 0;
        return true;
      });
      ASSERT_EQ(found, expected) << "triangle " << i << " in round " << round;
      nearOnes += expected;
      visits += visited;
      firstVisits += round == 0 ? visited : 0;
    }
  }
  EXPECT_GT(nearOnes, 100u);
  EXPECT_LT(visits, 20 * firstVisits);
}

TEST(NearParts, AreFoundWhereListsWouldBeTooLong) {
  const Scene scene = fallingSheet(13);
  const Cloth cloth(scene);
  const auto surface = makeSurface<float>(cloth, scene, {});
  State state = initialState(cloth, scene);
  for (auto& x : state.positions) x = {0.01f * x.x, 0.01f * x.y, 0.01f * x.z, 0};  // all near all
  cpu::SurfaceBoxes<float> boxes = boxesAround(surface, state);
  cpu::NearParts<float> near;
  near.update(surface, boxes, {}, {}, surface.around, surface.margin, flatBlocks(surface, state, FAR));
  cpu::SurfaceSearch<float>::growTree(surface, boxes.triangles);
  const cpu::SurfaceSearch<float> search{surface, boxes.triangles};
  std::size_t all = 0;
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    std::vector<std::uint32_t> expected;
    search.forEachPair(i, boxes, [&](const cpu::Parts& parts) {
      expected.insert(expected.end(), {parts.first, parts.second, parts.k, parts.l});
    });
    ASSERT_EQ(meetingParts(surface, near, i, boxes, nullptr), expected) << "triangle " << i;
    all += expected.size() / 4;
  }
  EXPECT_GT(all, cpu::NearParts<float>::MOST * surface.triangles.size() / cpu::NearParts<float>::TRIANGLES);
}

using Laws = cpu::SurfaceLaws<double>;
using Places = std::array<Vec3d, 4>;

bool staysApart(bool areSides, Places from, Places to, int parts) {
  const Vec3d way = Laws::nearestParts(areSides, from[0], from[1], from[2], from[3]).way;
  return Laws::staysApart(areSides, from.data(), to.data(), way, 1e-5, parts);
}

// A point above a triangle, and two sides that cross, at a distance that is small against their size.
const Places pointAndTriangle{{{0.01, 0.0002, 0.01}, {0, 0, 0}, {0.03, 0, 0}, {0, 0, 0.03}}};
const Places twoSides{{{0.01, 0.0002, -0.01}, {0.01, 0.0002, 0.02}, {0, 0, 0}, {0.03, 0, 0}}};

TEST(StaysApart, LetsPartsTurnTogether) {
  for (const double degrees : {1.0, 10.0, 40.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    const auto turned = [&](Places places) {
      for (Vec3d& p : places)
        p = {0.02 + std::cos(angle) * p.x - std::sin(angle) * p.y,
             std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
      return places;
    };
    EXPECT_TRUE(staysApart(false, pointAndTriangle, turned(pointAndTriangle), FINE_PARTS)) << degrees;
    EXPECT_TRUE(staysApart(true, twoSides, turned(twoSides), FINE_PARTS)) << degrees;
  }
}

TEST(StaysApart, LetsNothingThrough) {
  for (const int parts : {1, FINE_PARTS}) {
    Places point = pointAndTriangle, sides = twoSides;
    point[0].y = -0.0002;
    EXPECT_FALSE(staysApart(false, pointAndTriangle, point, parts));
    sides[0].y = sides[1].y = -0.0002;
    EXPECT_FALSE(staysApart(true, twoSides, sides, parts));
    // Far away at the end, but through the triangle on the way.
    EXPECT_FALSE(staysApart(false, {{{0.02, 0.001, 0.005}, {0, 0, 0}, {0.03, 0, 0}, {0, 0, 0.03}}},
                            {{{-0.02, -0.01, 0.005}, {0, 0, 0}, {0.03, 0, 0}, {0, 0, 0.03}}}, parts));
  }
}

// A sheet of 9 x 9 places that is bent, sheared and crumpled: its boxes of sides, and where places of it lie.
struct BentSheet {
  static constexpr int N = 9;
  Vec3d places[N][N];
  BentSheet(double bend, double shear, double noise, std::mt19937& random) {
    std::uniform_real_distribution<double> any(-noise, noise);
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) {
        const double s = i + shear * j + any(random), angle = bend * s;
        places[j][i] = bend > 0 ? Vec3d{std::sin(angle) / bend, (1 - std::cos(angle)) / bend, j + any(random)}
                                : Vec3d{s, any(random), j + any(random)};
      }
  }
  [[nodiscard]] double stretch() const {
    Vec3d low[2] = {{9, 9, 9}, {9, 9, 9}}, high[2] = {{-9, -9, -9}, {-9, -9, -9}};
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i)
        for (int k = 0; k < 2; ++k) {
          if ((k == 0 ? i : j) + 1 == N) continue;
          const Vec3d side = (k == 0 ? places[j][i + 1] : places[j + 1][i]) - places[j][i];
          low[k] = {std::min(low[k].x, side.x), std::min(low[k].y, side.y), std::min(low[k].z, side.z)};
          high[k] = {std::max(high[k].x, side.x), std::max(high[k].y, side.y), std::max(high[k].z, side.z)};
        }
    return Laws::leastStretch(low[0], high[0], low[1], high[1]);
  }
  // Between the columns and rows, on the triangles.
  [[nodiscard]] Vec3d at(double u, double v) const {
    const int i = std::min(static_cast<int>(u), N - 2), j = std::min(static_cast<int>(v), N - 2);
    const double s = u - i, t = v - j;
    const Vec3d &a = places[j][i], &b = places[j][i + 1], &c = places[j + 1][i], &d = places[j + 1][i + 1];
    return s + t < 1 ? a + s * (b - a) + t * (c - a) : d + (1 - s) * (c - d) + (1 - t) * (b - d);
  }
};

TEST(LeastStretch, BoundsAllDistancesOfASheetFromBelow) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, BentSheet::N - 1);
  int known = 0;
  for (const double bend : {0.0, 0.1, 0.2, 0.5})
    for (const double shear : {0.0, 0.2})
      for (const double noise : {0.0, 0.1, 0.3}) {
        const BentSheet sheet(bend, shear, noise, random);
        const double stretch = sheet.stretch();
        known += stretch > 0.4 ? 1 : 0;
        for (int k = 0; k < 2000; ++k) {
          const double u = place(random), v = place(random), otherU = place(random), otherV = place(random);
          const double rest = std::hypot(otherU - u, otherV - v);
          ASSERT_GE(length(sheet.at(otherU, otherV) - sheet.at(u, v)), (stretch - 1e-6) * rest)
              << bend << ' ' << shear << ' ' << noise;
        }
      }
  EXPECT_GE(known, 4) << "it says something of sheets that are bent a little";
  EXPECT_NEAR(BentSheet(0, 0, 0, random).stretch(), 1, 1e-6);
  EXPECT_LT(BentSheet(1, 0, 0, random).stretch(), 0) << "it has rolled up";
}

TEST(ClothSurface, HasBlocksWhereAGridIsWhole) {
  Scene scene = fallingSheet(10);
  const Cloth cloth(scene);
  const ClothSurface<float> surface = makeSurface<float>(cloth, scene, {});
  ASSERT_EQ(surface.blocks.size(), 9u) << "of 4, 4 and 1 cells";
  EXPECT_TRUE(surface.isOneGrid);
  EXPECT_EQ(surface.blocks[8].first, 88u);
  EXPECT_EQ(surface.blocks[8].width, 2u);
  std::array<int, 9> triangles{};
  for (const SurfaceTriangle& triangle : surface.triangles) ++triangles.at(triangle.block);
  EXPECT_EQ(triangles[0], 32);
  EXPECT_EQ(triangles[8], 2);
  Cuts cuts(cloth.particleCount());
  ASSERT_TRUE(cutAlong(cuts, cloth, 0, {2.5, 2.5}, {6.5, 2.5}));
  EXPECT_TRUE(makeSurface<float>(cloth, scene, cuts).blocks.empty());
}

TEST(ClothSurface, SharesCornersAndSidesAmongItsTriangles) {
  const Scene scene = fallingSheet(9);
  const Cloth cloth(scene);
  const ClothSurface<float> surface = makeSurface<float>(cloth, scene, {});
  ASSERT_EQ(surface.triangles.size(), 128u);
  int corners = 0, sides = 0, borders = 0;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners += static_cast<int>(triangle.owned >> k & 1u);
      sides += static_cast<int>(triangle.owned >> (OWNED_SIDE + k) & 1u);
    }
    for (const std::uint32_t across : {triangle.acrossAB, triangle.acrossBC, triangle.acrossCA})
      borders += across == NO_PARTICLE ? 1 : 0;
  }
  EXPECT_EQ(corners, 81);
  EXPECT_EQ(sides, 2 * 72 + 64);
  EXPECT_EQ(borders, 32);
  EXPECT_EQ(surface.firstBoxes.back(), 128u + 32 + 8 + 2 + 1);
  EXPECT_EQ(surface.points[0].radius, static_cast<float>(scene.cloths[0].material->thickness / 2));
}

}  // namespace
}  // namespace clothsim
