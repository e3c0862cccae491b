// Rows on the wind: a plate at an angle, and a sheet that falls flat.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cloth/material.h"
#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"
#include "unit/validation/row.h"

namespace clothsim::validation {
namespace {

// Sum of the wind's forces on a plate of 1 m x 1 m at rest, turned about x, with the points inside moved at
// random within the plate by up to a third of their spacing: triangles of all shapes.
template <class Real>
Vec3d windOnPlate(const Wind& wind, double degrees, int points) {
  Scene scene = test::sheetScene(points);
  scene.cloths[0].rotation = {degrees, 0, 0};
  scene.cloths[0].enableStructural = scene.cloths[0].enableShearing = scene.cloths[0].enableBending = false;
  scene.wind = wind;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  const Piece& piece = cloth.pieces()[0];
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3d alongRow{1, 0, 0}, alongColumn{0, -std::sin(angle), std::cos(angle)};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> third(-1.0 / 3, 1.0 / 3);
  for (int row = 1; row + 1 < points; ++row)
    for (int column = 1; column + 1 < points; ++column) {
      const std::uint32_t i = piece.particle(column, row);
      const double u = third(random) / (points - 1), v = third(random) / (points - 1);
      solver.setPosition(i, (cloth.positions()[i] + u * alongRow + v * alongColumn).cast<Real>());
    }
  Vec3d sum{};
  for (const Vec3<Real>& force : solver.forces()) sum = sum + force.template cast<double>();
  return sum;
}

template <class Real>
void expectPressure() {
  const Wind wind{.velocity = {0.5, -2, 1}, .gust = {}, .drag = 1.3, .lift = 0, .airDensity = 1.2};
  for (const double degrees : {0.0, 30.0, 75.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3d normal{0, std::cos(angle), std::sin(angle)};
    const double through = dot(wind.velocity, normal);
    const Vec3d expected = (0.5 * 1.2 * 1.3 * through * std::abs(through)) * normal;
    double largest = 0;
    for (const int points : {2, 5, 14}) {
      const Vec3d error = windOnPlate<Real>(wind, degrees, points) - expected;
      largest = std::max(largest, std::sqrt(dot(error, error)));
    }
    expectAtMost({"wind on a plate",
                  std::to_string(static_cast<int>(degrees)) +
                      " degrees, error of the force over its size, worst of three triangulations",
                  precisionOf<Real>, ""},
                 largest / std::sqrt(dot(expected, expected)), 1e-6);
  }
}

TEST(RowWindOnAPlate, PressesAlongItsNormalWhateverTheTriangulation) {
  expectPressure<double>();
  expectPressure<float>();
}

constexpr double SHEET_DENSITY = 0.2;

// A sheet that falls flat, and stiff enough in bending to stay so: a triangle's corners carry equal parts of
// the air's force, but the sheet's corners have other masses.
Scene fallingSheet(Integrator integrator) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.numWidthPoints = cloth.numHeightPoints = 17;
  cloth.material =
      Material{.density = SHEET_DENSITY, .stretch = 2000, .shear = 500, .bend = 0.05, .damping = 0};
  scene.gravity = {0, -GRAVITY, 0};
  scene.wind = Wind{.velocity = {0, 0, 0}, .gust = {}, .drag = 1.2, .lift = 0, .airDensity = 1.2};
  scene.solver.integrator = integrator;
  return scene;
}

double terminalSpeed() {
  const double terminal = std::sqrt(2 * SHEET_DENSITY * GRAVITY / (1.2 * 1.2));
  EXPECT_NEAR(terminal, 1.650757, 1e-6);
  return terminal;
}

// Of all particles downwards, weighted by their masses.
template <class Real>
double meanSpeed(const Cloth& sheet, const CpuSolver<Real>& solver) {
  double momentum = 0, mass = 0;
  for (std::uint32_t i = 0; i < sheet.particleCount(); ++i) {
    momentum -= static_cast<double>(solver.velocity(i).y) / sheet.inverseMasses()[i];
    mass += 1 / sheet.inverseMasses()[i];
  }
  return momentum / mass;
}

const std::string fallRow = "flat sheet falling, quadratic drag";

template <class Real>
void expectFallWithDrag(std::initializer_list<int> tenthsOfSeconds) {
  Scene scene = fallingSheet(Integrator::euler);
  scene.solver.framesPerSec = 10;
  scene.solver.simulationSteps = std::max(1000, stableSteps(scene));
  const Cloth sheet(scene);
  CpuSolver<Real> solver(sheet, scene);
  for (const int tenths : tenthsOfSeconds) {
    const double t = 0.1 * tenths;
    solver.step(tenths * scene.solver.simulationSteps - static_cast<int>(solver.stepIndex()));
    const double expected = terminalSpeed() * std::tanh(GRAVITY * t / terminalSpeed());
    char what[40];
    std::snprintf(what, sizeof what, "speed after %.1f s", t);
    expectNear({fallRow, what, precisionOf<Real>, "m/s"}, meanSpeed(sheet, solver), expected,
               1e-3 * expected);
  }
}

// The speed at the end does not depend on the step.
template <class Real>
void expectImplicitTerminalSpeed() {
  Scene scene = fallingSheet(Integrator::implicit);
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  const Cloth sheet(scene);
  CpuSolver<Real> solver(sheet, scene);
  solver.step(90);
  expectNear({fallRow, "terminal speed, implicit steps of 1/60 s", precisionOf<Real>, "m/s"},
             meanSpeed(sheet, solver), terminalSpeed(), 1e-3 * terminalSpeed());
}

TEST(RowFallingFlatSheet, ReachesItsTerminalSpeedInImplicitSteps) {
  expectImplicitTerminalSpeed<double>();
  expectImplicitTerminalSpeed<float>();
}

TEST(RowFallingFlatSheet, FollowsTheHyperbolicTangent) {
  expectFallWithDrag<double>({1, 2, 5});
  expectFallWithDrag<float>({1, 2, 5});
}

TEST(RowFallingFlatSheet, LongReachesItsTerminalSpeed) {
  expectFallWithDrag<double>({10, 20});
  expectFallWithDrag<float>({10, 20});
}

}  // namespace
}  // namespace clothsim::validation
