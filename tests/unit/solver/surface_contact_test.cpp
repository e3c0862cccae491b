// What contact inside the implicit step works with (solver/surface.h); how layers behave:
// tests/unit/validation/layer_contact_test.cpp.
#include "solver/surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/thread_team.h"
#include "solver/cpu/cpu_solver.h"
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
  const State alone = after(scene, 70);
  ThreadTeam::setSharedThreads(3);
  const State together = after(scene, 70);
  ThreadTeam::setSharedThreads(threads);
  for (std::size_t i = 0; i < alone.positions.size(); ++i) {
    ASSERT_EQ(alone.positions[i].x, together.positions[i].x) << i;
    ASSERT_EQ(alone.positions[i].y, together.positions[i].y) << i;
    ASSERT_EQ(alone.velocities[i].z, together.velocities[i].z) << i;
  }
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
