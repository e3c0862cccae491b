// The first six rows of PHYSICS.md section 5 (cases with known answers) for `verlet` and `euler`, in double
// and binary32.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

using test::sheetScene;
using test::springScene;

constexpr double MASS = 0.01, STIFFNESS = 40, STEP = 1e-3;

// The angle a step of a swing u(n) = A cos(n theta + phi), from u(n+1) + u(n-1) = 2 cos(theta) u(n) by least
// squares.
template <class Real>
double phasePerStep(Integrator integrator, int steps) {
  const Scene scene = springScene(1, STIFFNESS, MASS, STEP, integrator);
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.setPosition(1, {0, Real(-1.25), 0});
  std::vector<double> u;
  for (int i = 0; i < steps; ++i, solver.step(1)) u.push_back(-1 - static_cast<double>(solver.position(1).y));
  double products = 0, squares = 0;
  for (std::size_t i = 1; i + 1 < u.size(); ++i) {
    products += u[i] * (u[i + 1] + u[i - 1]);
    squares += u[i] * u[i];
  }
  return std::acos(products / (2 * squares));
}

TEST(MassOnASpring, TurnsByTheDiscretePhaseInEveryStep) {
  const double omega = std::sqrt(STIFFNESS / MASS);
  const double expected = 2 * std::asin(omega * STEP / 2);
  for (const Integrator integrator : {Integrator::verlet, Integrator::euler}) {
    EXPECT_NEAR(phasePerStep<double>(integrator, 4000), expected, 1e-10);
    EXPECT_NEAR(phasePerStep<float>(integrator, 4000), expected, 1e-5);
  }
}

// Position error at t = 0.5 s against u(t) = A cos(omega t).
double swingError(Integrator integrator, double timeStep) {
  const Scene scene = springScene(1, STIFFNESS, MASS, timeStep, integrator);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setPosition(1, {0, -1.25, 0});
  solver.step(static_cast<int>(std::lround(0.5 / timeStep)));
  return std::abs(-1 - solver.position(1).y - 0.25 * std::cos(std::sqrt(STIFFNESS / MASS) * 0.5));
}

double orderOf(Integrator integrator) {
  return std::log2(swingError(integrator, 1e-4) / swingError(integrator, 0.5e-4));
}

TEST(OrderOfConvergence, IsTwoForVerletAndOneForSymplecticEuler) {
  EXPECT_NEAR(orderOf(Integrator::verlet), 2, 0.02);
  EXPECT_NEAR(orderOf(Integrator::euler), 1, 0.05);
}

struct EnergyErrors {
  double largest = 0, firstHalf = 0, secondHalf = 0;  // relative; the halves tell a trend
};

EnergyErrors energyErrors(Integrator integrator) {
  constexpr int steps = 200000;
  const Scene scene = springScene(1, STIFFNESS, MASS, STEP, integrator);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.setPosition(1, {0, -1.25, 0});
  const double start = 0.5 * STIFFNESS * 0.25 * 0.25;
  EnergyErrors errors;
  for (int i = 1; i < steps; ++i) {
    solver.step(1);
    const double u = -1 - solver.position(1).y;
    double v = solver.velocity(1).y;  // of the half step before under verlet: v(n) = v(n-1/2) + a h / 2
    if (integrator == Integrator::verlet) v += 0.5 * STEP * STIFFNESS * u / MASS;
    const double error = std::abs((0.5 * MASS * v * v + 0.5 * STIFFNESS * u * u) / start - 1);
    errors.largest = std::max(errors.largest, error);
    double& half = i < steps / 2 ? errors.firstHalf : errors.secondHalf;
    half = std::max(half, error);
  }
  return errors;
}

TEST(EnergyOverTwoHundredThousandSteps, StaysWithinItsBoundWithoutATrend) {
  const double x = std::sqrt(STIFFNESS / MASS) * STEP;
  const EnergyErrors verlet = energyErrors(Integrator::verlet), euler = energyErrors(Integrator::euler);
  EXPECT_NEAR(verlet.largest, x * x / 4, 0.01 * x * x / 4);
  EXPECT_NEAR(euler.largest, (x / 2) / (1 - x / 2), 0.01 * (x / 2) / (1 - x / 2));
  EXPECT_NEAR(verlet.firstHalf, verlet.secondHalf, 1e-3 * verlet.largest);
  EXPECT_NEAR(euler.firstHalf, euler.secondHalf, 1e-3 * euler.largest);
}

// Period from two crossings of the vertical in the same direction, interpolated.
double pendulumPeriod(double degrees) {
  constexpr double h = 1e-4, g = 9.81, stiffness = 1e6;
  Scene scene = springScene(1, stiffness, 1, h, Integrator::verlet);
  scene.gravity = {0, -g, 0};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const double angle = degrees * std::numbers::pi / 180;
  const double length = 1 + g * std::cos(angle) / stiffness;
  solver.setPosition(1, {length * std::sin(angle), -length * std::cos(angle), 0});
  std::vector<double> crossings;
  double before = solver.position(1).x;
  for (int i = 1; crossings.size() < 2; ++i) {
    solver.step(1);
    const double now = solver.position(1).x;
    if (before > 0 && now <= 0) crossings.push_back(h * (i - now / (now - before)));
    before = now;
  }
  return crossings[1] - crossings[0];
}

TEST(Pendulum, SwingsWithThePeriodOfTheEllipticIntegral) {
  EXPECT_NEAR(pendulumPeriod(10), 2.009892627, 1e-4);
  EXPECT_NEAR(pendulumPeriod(60), 2.152874667, 1e-4);
  EXPECT_NEAR(pendulumPeriod(90), 2.367841948, 1e-4);
}

// How far a free sheet has fallen after 1 s, less g t^2 / 2, relative to that.
template <class Real>
double freeFallError(Integrator integrator, int stepsPerSecond) {
  Scene scene = sheetScene(4);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 1;
  scene.cloths[0].damping = 0;
  scene.gravity = {0, -9.81, 0};
  scene.solver.integrator = integrator;
  scene.solver.framesPerSec = 1;
  scene.solver.simulationSteps = stepsPerSecond;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  solver.step(stepsPerSecond);
  return (1 - static_cast<double>(solver.position(5).y) - 4.905) / 4.905;
}

TEST(FreeFall, IsExactUnderVerletAndHalfAStepAheadUnderEuler) {
  EXPECT_NEAR(freeFallError<double>(Integrator::verlet, 1000), 0, 1e-12);
  EXPECT_NEAR(freeFallError<double>(Integrator::euler, 1000), 9.81 * 0.5e-3 / 4.905, 1e-12);
}

TEST(FreeFall, KeepsItsAccuracyInBinary32AtTinySteps) {
  const double fine = freeFallError<float>(Integrator::verlet, 10'000),
               finer = freeFallError<float>(Integrator::verlet, 100'000);
  std::printf("free fall, 1 s, binary32: relative error %.2e at h = 1e-4, %.2e at h = 1e-5\n", fine, finer);
  EXPECT_NEAR(fine, 0, 2e-5);
  EXPECT_NEAR(finer, 0, 1e-3);
}

template <class Real>
void expectMomentumIsKept(double tolerance) {
  Scene scene = sheetScene(20);
  scene.gravity = {0, 0, 0};
  scene.cloths[0].damping = 0;
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.01, 0.01), speed(-1, 1);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = cloth.positions()[i] + Vec3d{jitter(random), jitter(random), jitter(random)};
    solver.setPosition(i, x.cast<Real>());
    solver.setVelocity(i, Vec3d{speed(random), speed(random), speed(random)}.cast<Real>());
  }
  Vec3d sum{}, momentum{}, momentumAfter{};
  double magnitude = 0, speeds = 0;
  for (const Vec3<Real>& force : solver.forces()) {
    const auto f = force.template cast<double>();
    sum = sum + f;
    magnitude += std::sqrt(dot(f, f));
  }
  const auto total = [&] {
    Vec3d p{};
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      p = p + solver.velocity(i).template cast<double>();
    return p;
  };
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const auto v = solver.velocity(i).template cast<double>();
    speeds += std::sqrt(dot(v, v));
  }
  momentum = total();
  solver.step(200);
  momentumAfter = total();
  EXPECT_LT(std::sqrt(dot(sum, sum)) / magnitude, tolerance) << "the sum of all forces";
  const Vec3d change = momentumAfter - momentum;
  EXPECT_LT(std::sqrt(dot(change, change)) / speeds, tolerance) << "the sum of all momenta";
}

TEST(Momentum, IsKeptWithoutGravity) {
  expectMomentumIsKept<double>(1e-13);
  expectMomentumIsKept<float>(1e-5);
}

}  // namespace
}  // namespace clothsim
