// Points that pull or push: their force, its energy and momentum, and what implicit steps make of it.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/cpu/cpu_solver.h"
#include "support/lone_particle.h"
#include "support/mesh_sheet.h"

namespace clothsim {
namespace {

// One free particle of 1 kg, far from another on a slack spring, without gravity.
Scene particleAnd(const Attractor& attractor, Integrator integrator, double timeStep) {
  Scene scene = test::springScene(1, 1e-9, 1, timeStep, integrator);
  scene.cloths[0].pinned.clear();
  scene.cloths[0].damping = 0;
  scene.solver.maxStrain = 1e6;
  scene.attractors = {attractor};
  return scene;
}

using test::afterSteps;
using test::LoneParticle;

// The law as the documents have it: S c q (1 - q^2)^2, and the potential whose slope that is.
constexpr double unitPeak = 3.4938562148434216;  // 25 sqrt(5) / 16
double accelerationAt(const Attractor& a, double r) {
  const double q = r / a.radius;
  return q < 1 ? a.strength * unitPeak * q * std::pow(1 - q * q, 2) : 0;
}
double potentialAt(const Attractor& a, double r) {
  const double q = std::min(r / a.radius, 1.0);
  return a.strength * unitPeak * a.radius * (1 - std::pow(1 - q * q, 3)) / 6;
}

TEST(Attractors, PullByTheirStrengthAtMostAndNotAtAllFromTheirRadiusOn) {
  for (const double strength : {8.0, -3.0}) {
    const Attractor attractor{.position = {1, 2, 3}, .strength = strength, .radius = 0.5};
    const Scene scene = particleAnd(attractor, Integrator::euler, 1e-3);
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    for (const double r : {0.0, 0.02, 0.5 / std::sqrt(5), 0.4, 0.4999, 0.5, 0.8}) {
      const Vec3d away{0.6, 0, -0.8};
      solver.setPosition(1, attractor.position + r * away);
      const Vec3d force = solver.forces()[1];
      EXPECT_NEAR(dot(force, away), -accelerationAt(attractor, r), 1e-6) << r;
      EXPECT_NEAR(length(force), std::abs(accelerationAt(attractor, r)), 1e-6) << r;
    }
    EXPECT_NEAR(accelerationAt(attractor, 0.5 / std::sqrt(5)), strength, 1e-12);
    constexpr double e = 1e-6;
    const double slope = (potentialAt(attractor, 0.3 + e) - potentialAt(attractor, 0.3 - e)) / (2 * e);
    EXPECT_NEAR(slope, accelerationAt(attractor, 0.3), 1e-8);
  }
}

TEST(Attractors, KeepEnergyAndAngularMomentumOfAParticleThatCircles) {
  const Attractor attractor{.strength = 5, .radius = 0.5};
  const Scene scene = particleAnd(attractor, Integrator::euler, 1e-4);
  const LoneParticle start{{0.3, 0, 0}, {0, 0.4, 0.5}};
  const auto energy = [&](const LoneParticle& p) {
    return 0.5 * dot(p.v, p.v) + potentialAt(attractor, length(p.x));
  };
  for (const int steps : {1000, 5000}) {
    const LoneParticle end = afterSteps(scene, start, steps);
    EXPECT_GT(length(end.x - start.x), 0.05);
    EXPECT_NEAR(energy(end), energy(start), 1e-3 * energy(start));
    // The slack spring to the other particle, 500 m away, pulls with 5e-7 N.
    EXPECT_NEAR(length(cross(end.x, end.v) - cross(start.x, start.v)), 0, 2e-7);
  }
}

TEST(Attractors, GiveGridsAndMeshesTheMomentumOfTheirForces) {
  Scene piece = test::sheetScene(9), mesh = test::meshScene({.columns = 8, .rows = 8, .edge = 0.1});
  mesh.cloths[0].pinned.clear();
  for (Scene* scene : {&piece, &mesh}) {
    scene->gravity = {0, 0, 0};
    scene->cloths[0].damping = 0;
    scene->solver.integrator = Integrator::euler;
    scene->attractors = {{.position = {0.3, 1.1, 0.4}, .strength = 12, .radius = 0.9},
                         {.position = {0.4, -0.3, 0.2}, .strength = -7, .radius = 0.8}};
    const Cloth cloth(*scene);
    CpuSolver<double> solver(cloth, *scene);
    solver.step(1);
    Vec3d momentum, impulse;
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      const double mass = 1 / cloth.inverseMasses()[i];
      momentum = momentum + mass * solver.velocity(i);
      for (const Attractor& attractor : scene->attractors) {
        const Vec3d towards = attractor.position - cloth.positions()[i];
        const double r = length(towards), h = stepLength(scene->solver);
        impulse = impulse + (h * mass * accelerationAt(attractor, r) / r) * towards;
      }
    }
    EXPECT_GT(length(impulse), 1e-6);
    EXPECT_NEAR(length(momentum - impulse), 0, 1e-6 * length(impulse));
  }
}

// (1/h^2 + p) d = v/h + a with p = S c / R (1 - q^2)^2 of a pull, 0 of a push; v' = d / h.
TEST(Attractors, AreSpringsInImplicitStepsWhereTheyPull) {
  constexpr double h = 1.0 / 60;
  for (const double strength : {30.0, -30.0}) {
    const Attractor attractor{.strength = strength, .radius = 0.5};
    const LoneParticle start{{0.2, 0, 0}, {0.1, 0.3, 0}};
    Scene scene = particleAnd(attractor, Integrator::implicit, h);
    scene.solver.tolerance = 1e-6;
    const LoneParticle end = afterSteps(scene, start, 1);
    const double a = accelerationAt(attractor, 0.2), p = std::max(a / 0.2, 0.0);
    EXPECT_NEAR(end.v.x, (0.1 / h - a) / (1 / h + h * p), 1e-6);
    EXPECT_NEAR(end.v.y, (0.3 / h) / (1 / h + h * p), 1e-6);
  }
}

TEST(Attractors, OfAnyStrengthLetParticlesComeToRestInImplicitSteps) {
  const Attractor attractor{.strength = 1e6, .radius = 0.5};
  const LoneParticle end =
      afterSteps(particleAnd(attractor, Integrator::implicit, 1.0 / 60), {{0.3, 0.1, 0}, {}}, 60);
  EXPECT_LT(length(end.x), 1e-3);
  EXPECT_LT(length(end.v), 1e-1);
}

}  // namespace
}  // namespace clothsim
