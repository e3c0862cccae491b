// Forces and largest stable step of a material; rows with known answers are in unit/validation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using test::materialSheet;

TEST(MaterialForces, VanishWhereTheSheetIsOnlyMovedAndTurned) {
  const Scene scene = materialSheet(6, 5, 1, 0.8, {.stretch = 5000, .shear = 500, .bend = 0.01});
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
  const Scene scene = materialSheet(n, 3, length, 2 * length / (n - 1), paper);
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
  const Vec3d end = forces[cloth.pieces()[0].particle(n - 1, 1)];
  const double expected = paper.bend / radius / h * (2 * length / (n - 1) / 2);
  EXPECT_NEAR(std::sqrt(dot(end, end)), expected, 0.01 * expected);
}

TEST(StableStep, IsStableForACrumpledSheetAndNotFarFromTheLargestOne) {
  const Material fabric{.stretch = 2000, .shear = 300, .bend = 1e-4, .damping = 0};
  const auto speedAfter = [&](double factor) {
    Scene scene = materialSheet(12, 12, 0.5, 0.5, fabric);
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

// A sheet of cotton that hangs from its top sags by rho g L^2 / (2 Y), standing from the start or turned into
// place from lying.
double sagOfHungCotton(int points, bool stands) {
  const Material cotton = *materialPreset("cotton");
  Scene scene = materialSheet(points, points, 1, 1, cotton);
  ClothSettings& sheet = scene.cloths[0];
  sheet.orientation = stands ? Orientation::vertical : Orientation::horizontal;
  if (!stands) sheet.rotation = {90, 0, 0};
  sheet.pinned = {GridSide::top};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 1;
  scene.solver.newtonSteps = 1;
  scene.solver.cgIterations = 25;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(5);
  const std::uint32_t bottom = cloth.pieces()[0].particle(points / 2, stands ? 0 : points - 1);
  return cloth.positions()[bottom].y - solver.position(bottom).y;
}

TEST(HungSheet, SagsByItsStretchAloneHoweverItWasPutThere) {
  const Material cotton = *materialPreset("cotton");
  const double expected = cotton.density * 9.81 / (2 * cotton.stretch);
  for (const int points : {33, 65}) {
    const double stood = sagOfHungCotton(points, true), turned = sagOfHungCotton(points, false);
    EXPECT_NEAR(stood / expected, 1, 0.1) << points;
    EXPECT_NEAR(stood / turned, 1, 0.1) << points;
  }
}

}  // namespace
}  // namespace clothsim
