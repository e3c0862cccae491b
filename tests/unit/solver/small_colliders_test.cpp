// Colliders that are small against the cells of the cloth, in implicit steps of 1/60 s.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "cloth/cuts.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/surface_laws.h"
#include "solver/surface.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using Laws = cpu::SurfaceLaws<double>;

// The solid angle of the sheet, seen from a point, over 4 pi: above a half on one side of it and as far below
// zero on the other. A. van Oosterom and J. Strackee, "The solid angle of a plane triangle", 1983.
double sideOf(const Cloth& cloth, CpuSolver<float>& solver, Vec3d p) {
  double sum = 0;
  for (const auto& corners : remainingTriangles(cloth, {})) {
    std::array<Vec3d, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = solver.position(corners[k]).cast<double>() - p;
    const double a = length(d[0]), b = length(d[1]), c = length(d[2]);
    sum += 2 * std::atan2(dot(d[0], cross(d[1], d[2])),
                          a * b * c + dot(d[0], d[1]) * c + dot(d[1], d[2]) * a + dot(d[2], d[0]) * b);
  }
  return sum / (4 * std::numbers::pi);
}

constexpr int POINTS = 9;
constexpr double CELL = 0.015;

// A standing sheet, pinned at two of its sides, and a collider that comes along z.
Scene pinnedSheet(Collider collider) {
  const double size = (POINTS - 1) * CELL;
  Scene scene = test::materialSheet(POINTS, POINTS, size, size, *materialPreset("silk"));
  scene.cloths[0].orientation = Orientation::vertical;
  for (int row = 0; row < POINTS; ++row)
    for (const int column : {0, POINTS - 1}) scene.cloths[0].pinned.push_back(GridPoint{column, row});
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 1;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::off;
  scene.colliders = {std::move(collider)};
  chooseCounts(scene);
  return scene;
}

// From 5 mm before the sheet to 30 mm behind it, through the inside of a triangle.
constexpr double WAY = 0.035;
Motion through(double radius, double speed) {
  const Vec3d begin{3.8 * CELL, 4.3 * CELL, radius + 0.005};
  return {.keys = {{0, begin, {}}, {WAY / speed, begin - Vec3d{0, 0, WAY}, {}}}};
}

TEST(SmallColliders, DoNotPassBetweenParticles) {
  for (const double cells : {0.2, 1.0})
    for (const double speed : {0.3, 10.0}) {
      const double radius = cells * CELL;
      const Motion motion = through(radius, speed);
      const Scene scene = pinnedSheet(Sphere{.radius = radius, .friction = 0.3, .motion = motion});
      const Cloth cloth(scene);
      CpuSolver<float> solver(cloth, scene);
      const double before = sideOf(cloth, solver, motion.keys[0].position);
      solver.step(10);
      const double after = sideOf(cloth, solver, motion.keys[1].position);
      EXPECT_GT(std::abs(after), 0.4) << cells << " cells at " << speed << " m/s: in the tip of the sheet";
      EXPECT_EQ(before > 0, after > 0) << cells << " cells at " << speed << " m/s";
      EXPECT_EQ(solver.contactCounts().passages, 0u);
    }
}

TEST(SmallColliders, DoNotPassAsThinRods) {
  const Capsule rod{
      .axis = {1, 0.3, 0}, .length = 0.04, .radius = 0.3 * CELL, .motion = through(0.3 * CELL, 1)};
  const Scene scene = pinnedSheet(rod);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const double before = sideOf(cloth, solver, rod.motion->keys[0].position);
  solver.step(10);
  EXPECT_EQ(before > 0, sideOf(cloth, solver, rod.motion->keys[1].position) > 0);
  EXPECT_EQ(solver.contactCounts().passages, 0u);
}

// Of what comes along z, how far its tip and the end of its core are before its place [m].
struct Thin {
  const char* name;
  double tip, core;
  std::function<Collider(const Motion&)> make;
};
std::vector<Thin> thinShapes() {
  const double size = 0.4 * CELL;
  const Vec3d forward{0, 0, -1};
  return {
      {"needle", 0.03, 0.03 - size,
       [=](const Motion& m) { return Cone{.axis = forward, .height = 0.06, .radius = size, .motion = m}; }},
      {"cylinder", 0.03, 0.03 - size,
       [=](const Motion& m) {
         return Cylinder{.axis = forward, .height = 0.06, .radius = size, .motion = m};
       }},
      {"die", size, 0,
       [=](const Motion& m) {
         return Box{.size = {2 * size, 2 * size, 2 * size}, .rounding = 0, .motion = m};
       }},
      {"corner", std::sqrt(3.0) * size, 0,
       [=](const Motion& m) {
         return Box{.size = {2 * size, 2 * size, 2 * size},
                    .rotation = {-88.575, 88.575, 0},
                    .rounding = 0,
                    .motion = m};
       }},
      {"card", 0.02, 0.019,
       [=](const Motion& m) {
         return Box{.size = {0.03, 0.002, 0.04}, .rounding = 0.0005, .motion = m};
       }},
      {"disc", 0.02, 0.0185,
       [=](const Motion& m) {
         return Cylinder{.axis = {0.2, 1, 0}, .height = 0.003, .radius = 0.02, .motion = m};
       }},
      {"ring", 0.025, 0.02,
       [=](const Motion& m) {
         return Torus{.axis = {1, 0.1, 0}, .radius = 0.02, .tubeRadius = 0.005, .motion = m};
       }},
  };
}

// Comes at a place of the sheet, counted in cells.
void expectStopped(const Thin& thin, double speed, double column = 3.8, double row = 4.3) {
  Motion motion = through(thin.tip, speed);
  for (Motion::Key& key : motion.keys) key.position = {column * CELL, row * CELL, key.position.z};
  const Scene scene = pinnedSheet(thin.make(motion));
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const Vec3d core{0, 0, thin.core};
  const double before = sideOf(cloth, solver, motion.keys[0].position - core);
  solver.step(static_cast<int>(60 * WAY / speed) + 9);
  const double after = sideOf(cloth, solver, motion.keys[1].position - core);
  EXPECT_EQ(before > 0, after > 0) << thin.name << " at " << speed << " m/s, " << column << ' ' << row;
  EXPECT_EQ(solver.contactCounts().passages, 0u) << thin.name << " at " << speed << " m/s";
}

TEST(SmallColliders, OfAllShapesDoNotPass) {
  for (const Thin& thin : thinShapes())
    for (const double speed : {0.3, 3.0, 10.0}) expectStopped(thin, speed);
}

// The sheet hangs as a tent over a needle, which soon is beside the particle at its top.
TEST(SmallColliders, DoNotPassAsNeedlesBesideParticles) {
  for (const double speed : {0.25, 0.35, 1.5, 5.0}) {
    expectStopped(thinShapes()[0], speed);
    expectStopped(thinShapes()[0], speed, 4.05, 4.1);
    expectStopped(thinShapes()[0], speed, 2.2, 5.3);
  }
}

TEST(SmallColliders, AreCountedWhereTheyPass) {
  Scene scene = pinnedSheet(Sphere{.radius = 0.2 * CELL, .motion = through(0.2 * CELL, 1)});
  for (int row = 0; row < POINTS; ++row)
    for (int column = 1; column < POINTS - 1; ++column)
      scene.cloths[0].pinned.push_back(GridPoint{column, row});
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(3);
  EXPECT_EQ(solver.contactCounts().passages, 1u) << "nothing of the sheet can go out of the way";
  EXPECT_EQ(solver.contactCounts().passageSteps, 1u);
}

TEST(SmallColliders, AreThoseThatAreThinAgainstCells) {
  const auto count = [](Collider collider) {
    const Scene scene = pinnedSheet(std::move(collider));
    return smallColliders(scene, Cloth(scene));
  };
  EXPECT_EQ(count(Sphere{.radius = 1.9 * CELL}), 1u);
  EXPECT_EQ(count(Sphere{.radius = 2.1 * CELL}), 0u);
  EXPECT_EQ(count(Capsule{.length = 1, .radius = 1.9 * CELL}), 1u);
  EXPECT_EQ(count(Box{.size = {1, 3.8 * CELL, 1}}), 1u);
  EXPECT_EQ(count(Box{.size = {1, 4.2 * CELL, 1}}), 0u);
  EXPECT_EQ(count(Cylinder{.height = 1, .radius = 1.9 * CELL}), 1u);
  EXPECT_EQ(count(Torus{.radius = 0.3, .tubeRadius = 1.9 * CELL}), 1u);
  EXPECT_EQ(count(Cone{.height = 1, .radius = 1}), 1u) << "it has a tip";
  EXPECT_EQ(count(Cone{.height = 1, .radius = 1, .topRadius = 2.1 * CELL}), 0u);
  Scene scene = pinnedSheet(Sphere{.radius = 0.5 * CELL});
  EXPECT_EQ(unseenColliders(scene, Cloth(scene)), 0u);
  scene.solver.integrator = Integrator::euler;
  EXPECT_EQ(smallColliders(scene, Cloth(scene)), 0u);
  EXPECT_EQ(unseenColliders(scene, Cloth(scene)), 1u) << "it passes, and that is said";
}

// One stiff cell on small balls, three under the inside of each of its triangles, on a slope of mu = 0.3.
double slideOnBalls(double degrees, int steps) {
  const Material board{.density = 0.5, .stretch = 8000, .shear = 8000, .bend = 1e-2, .damping = 0};
  Scene scene = test::materialSheet(2, 2, 0.2, 0.2, board);
  scene.cloths[0].position = {0, -1, 0};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 1;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::off;
  scene.solver.tolerance = 1e-4;
  scene.solver.newtonSteps = 20;
  scene.solver.cgIterations = 60;
  const double angle = degrees * std::numbers::pi / 180, radius = 0.02;
  scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
  for (const auto& [x, z] :
       {std::pair{0.03, 0.03}, {0.13, 0.03}, {0.03, 0.13}, {0.17, 0.17}, {0.07, 0.17}, {0.17, 0.07}})
    scene.colliders.push_back(Sphere{.origin = {x, -radius, z}, .radius = radius, .friction = 0.3});
  chooseCounts(scene);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(steps);
  return solver.position(0).x - cloth.positions()[0].x;
}

TEST(SmallColliders, RubByCoulombsLaw) {
  const double angle = 30 * std::numbers::pi / 180, a = 9.81 * (std::sin(angle) - 0.3 * std::cos(angle));
  const double expected = a * 6 * 7 / 2 / 3600;
  EXPECT_NEAR(slideOnBalls(30, 6), expected, 0.01 * expected);
  EXPECT_NEAR(slideOnBalls(15, 60), 0, 1e-5) << "tan 15 degrees is less than 0.3";
}

TEST(Meeting, IsWhereTheCorePassesATriangle) {
  shared::SmallCollider<double> ball{};
  ball.radius = 0.1;
  Vec3d from[3] = {{-1, 1, -1}, {2, 1, -1}, {-1, 1, 2}};
  const Vec3d down{0.3, -2, 0.1};  // the triangle is in the plane of the center after half of it
  Vec3d to[3] = {from[0] + down, from[1] + down, from[2] + down};
  const auto meeting = Laws::meetingOf(ball, from, to);
  EXPECT_TRUE(meeting.passes);
  EXPECT_NEAR(-1 + 3 * meeting.u + 0.15, 0, 1e-4);
  EXPECT_NEAR(-1 + 3 * meeting.v + 0.05, 0, 1e-4);
  const Vec3d aside{5, -2, 0};
  Vec3d beside[3] = {from[0] + aside, from[1] + aside, from[2] + aside};
  EXPECT_FALSE(Laws::meetingOf(ball, from, beside).passes);
}

TEST(Meeting, IsAtTheNearestPlacesOfTriangleAndSegment) {
  shared::SmallCollider<double> rod{};
  rod.radius = 0.1;
  rod.coreY = 0.5;
  const Vec3d a{0.4, 0.1, -0.5}, b{0.9, 0.9, 0.2}, c{0.3, -0.2, 0.6};
  double least = INFINITY;
  constexpr int fine = 60;
  for (int i = 0; i <= fine; ++i)
    for (int j = 0; i + j <= fine; ++j)
      for (int k = 0; k <= fine; ++k) {
        const Vec3d p = a + (1.0 * i / fine) * (b - a) + (1.0 * j / fine) * (c - a);
        least = std::min(least, length(p - Vec3d{0, -0.5 + 1.0 * k / fine, 0}));
      }
  EXPECT_NEAR(length(Laws::nearestToCore(rod, a, b, c).way), least, 0.01);
}

}  // namespace
}  // namespace clothsim
