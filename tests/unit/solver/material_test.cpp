// Rows of PHYSICS.md section 5 that tell a material: sag, patch test and cantilever; here with explicit
// steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "scene/material.h"
#include "solver/cpu/cpu_solver.h"

namespace clothsim {
namespace {

Scene materialScene(int columns, int rows, double width, double height, const Material& material) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.width = width;
  cloth.height = height;
  cloth.numWidthPoints = columns;
  cloth.numHeightPoints = rows;
  cloth.material = material;
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = Integrator::euler;
  scene.solver.framesPerSec = 60;
  scene.solver.maxStrain = 1e6;
  scene.solver.simulationSteps = stableSteps(scene);
  return scene;
}

// Steps until nothing moves, with friction that grows no slower than the slowest swing dies down.
void settle(CpuSolver<double>& solver, std::uint32_t particles, double speed) {
  for (int round = 0; round < 400; ++round) {
    solver.step(2000);
    double fastest = 0;
    for (std::uint32_t i = 0; i < particles; ++i) {
      const Vec3d v = solver.velocity(i);
      fastest = std::max(fastest, std::sqrt(dot(v, v)));
    }
    if (fastest < speed) return;
  }
  FAIL() << "does not come to rest";
}

// A sheet of 1 m hung from its upper edge: how far the middle of its lower edge sinks.
double sagOf(int n, double& reaction) {
  const Material sheet{.density = 0.1, .stretch = 280, .shear = 105, .bend = 0, .damping = 120};
  Scene scene = materialScene(n, n, 1, 1, sheet);
  scene.gravity = {0, 0, 9.81};  // in the sheet's plane, which it then never leaves
  scene.cloths[0].pinned = {GridSide::top};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  settle(solver, cloth.particleCount(), 1e-11);
  const std::vector<Vec3d> forces = solver.forces();
  reaction = 0;
  const Grid& grid = cloth.grids()[0];
  for (int column = 0; column < n; ++column) {
    const double mass = grid.particleMass * grid.massWeight(column, 0);
    reaction += forces[grid.particle(column, 0)].z + 9.81 * mass;
  }
  const std::uint32_t lowest = grid.particle(n / 2, n - 1);
  return solver.position(lowest).z - cloth.positions()[lowest].z;
}

TEST(SheetHungFromItsTopEdge, PullsWithItsWeightAndSagsTheSameAtEveryResolution) {
  double reaction = 0;
  const double coarse = sagOf(17, reaction);
  EXPECT_NEAR(reaction, 0.1 * 9.81, 1e-9);
  const double middle = sagOf(33, reaction), fine = sagOf(65, reaction);
  EXPECT_NEAR(reaction, 0.1 * 9.81, 1e-9);
  std::printf("sag at 17, 33, 65 points: %.6f %.6f %.6f m\n", coarse, middle, fine);
  EXPECT_NEAR(middle / fine, 1, 0.001);
  EXPECT_NEAR(coarse / fine, 1, 0.002);
  // Without Poisson's effect the strip would sag by rho g l^2 / (2 C11) to / (2 Y).
  EXPECT_GT(fine, 0.1 * 9.81 / (2 * 320));
  EXPECT_LT(fine, 0.1 * 9.81 / (2 * 270));
}

TEST(PatchTest, LeavesAnAffinelyStretchedSheetInBalanceInside) {
  const Scene scene = materialScene(9, 7, 1, 0.9, {.stretch = 5000, .shear = 500, .bend = 0.01});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = cloth.positions()[i];
    solver.setPosition(i, {1.2 * x.x + 0.3 * x.z, 0.5 * x.x - 0.2 * x.z, 0.1 * x.x + 0.9 * x.z});
  }
  const std::vector<Vec3d> forces = solver.forces();
  for (int row = 2; row < 5; ++row)
    for (int column = 2; column < 7; ++column) {
      const Vec3d f = forces[cloth.grids()[0].particle(column, row)];
      EXPECT_NEAR(std::sqrt(dot(f, f)), 0, 1e-10 * 5000);
    }
}

TEST(PatchTest, HasNoForceWhereTheSheetIsOnlyMovedAndTurned) {
  const Scene scene = materialScene(6, 5, 1, 0.8, {.stretch = 5000, .shear = 500, .bend = 0.01});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = cloth.positions()[i];
    solver.setPosition(i, {0.6 * x.x - 0.8 * x.z + 3, x.y, 0.8 * x.x + 0.6 * x.z});
  }
  for (const Vec3d& f : solver.forces()) EXPECT_NEAR(std::sqrt(dot(f, f)), 0, 1e-8);
}

TEST(BendingEnergy, IsThatOfACylinderForASheetRolledUp) {
  // Net moments vanish inside; what is left shows at the free ends: -b d at the last particle but for its
  // weight.
  const double radius = 0.5, length = 0.8;
  const int n = 41;
  const Material paper{.stretch = 1, .shear = 0.1, .bend = 0.02};
  const Scene scene = materialScene(n, 3, length, 2 * length / (n - 1), paper);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const double h = length / (n - 1), chord = 2 * radius * std::sin(h / (2 * radius));
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = cloth.positions()[i];
    const double angle = x.x / radius;
    solver.setPosition(
        i, {h / chord * radius * std::sin(angle), h / chord * radius * (1 - std::cos(angle)), x.z});
  }
  // A cylinder's moment a length is B / R; at the free end it is held by a pair of forces B / (R h) on the
  // last two particles of each line, weighted by the line's share of the width.
  const std::vector<Vec3d> forces = solver.forces();
  const Vec3d end = forces[cloth.grids()[0].particle(n - 1, 1)];
  const double expected = paper.bend / radius / h * (2 * length / (n - 1) / 2);
  EXPECT_NEAR(std::sqrt(dot(end, end)), expected, 0.01 * expected);
}

// The end of a strip clamped level at one end and bent by its weight, w l^3 / B = 4, in units of its length.
struct Tip {
  double along, down;
};
Tip cantileverTip(int n) {
  const double length = 1, density = 0.1, g = 9.81, h = length / n;
  const Material strip{.density = density,
                       .stretch = 1e4 * density * g * length,
                       .shear = 10 * density * g * length,
                       .bend = density * g * length * length * length / 4,
                       .damping = 6};
  Scene scene = materialScene(2, n + 2, h, length + h, strip);  // the clamp is the first cell
  scene.cloths[0].pinned = {GridRange{{0, 0}, {1, 1}}};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  settle(solver, cloth.particleCount(), 1e-7);
  const Grid& grid = cloth.grids()[0];
  const Vec3d clamp = cloth.positions()[grid.particle(0, 1)], tip = solver.position(grid.particle(0, n + 1));
  return {(tip.z - clamp.z) / length, (tip.y - clamp.y) / length};
}

TEST(CantileverStrip, BendsToTheElasticaWithSecondOrder) {
  const auto error = [](int n) {
    const Tip tip = cantileverTip(n);
    const double e = std::hypot(tip.along - 0.890111, tip.down + 0.425159);
    std::printf("%d cells: tip (%.6f, %.6f), expected (0.890111, -0.425159), error %.6f\n", n, tip.along,
                tip.down, e);
    return e;
  };
  const double coarse = error(8), middle = error(16), fine = error(32);
  EXPECT_LT(fine, 0.002);
  EXPECT_GT(coarse / middle, 3.5);
  EXPECT_LT(coarse / middle, 4.5);
  EXPECT_GT(middle / fine, 3.5);
  EXPECT_LT(middle / fine, 4.5);
}

TEST(StableStep, IsStableForACrumpledSheetAndNotFarFromTheLargestOne) {
  const Material fabric{.stretch = 2000, .shear = 300, .bend = 1e-4, .damping = 0};
  const auto speedAfter = [&](double factor) {
    Scene scene = materialScene(12, 12, 0.5, 0.5, fabric);
    scene.gravity = {0, 0, 0};
    scene.solver.framesPerSec = 1 / (factor * stableStep(scene));
    scene.solver.simulationSteps = 1;
    scene.solver.maxSpeed = 1e15;
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-0.002, 0.002);
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      solver.setPosition(i, cloth.positions()[i] + Vec3d{noise(random), noise(random), noise(random)});
    solver.step(2000);
    double speedSquared = 0;  // the mean
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      speedSquared += dot(solver.velocity(i), solver.velocity(i)) / cloth.particleCount();
    return std::sqrt(speedSquared);
  };
  EXPECT_LT(speedAfter(1), 20) << "no faster than the springs' own energy makes it";
  EXPECT_FALSE(speedAfter(2) < 1e3) << "the bound is within a factor of two";
}

}  // namespace
}  // namespace clothsim
