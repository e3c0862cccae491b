// Colliders in implicit steps of 1/60 s.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "export/formats.h"
#include "measure/measure.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/implicit_contact.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

// A horizontal sheet of 1 m x 1 m at height 1 m, free to fall on the collider.
Scene sheetOver(const Collider& collider, int points) {
  const Material linen{.density = 0.2, .stretch = 8000, .shear = 300, .bend = 1e-4, .damping = 0};
  Scene scene = test::materialSheet(points, points, 1, 1, linen);
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 1;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::off;
  scene.colliders = {collider};
  chooseCounts(scene);
  return scene;
}

TEST(ImplicitContact, BendsASheetAroundABallWithoutCrumplingIt) {
  const Sphere ball{.origin = {0.5, 0.7, 0.5}, .radius = 0.25, .friction = 0.4};
  const Scene scene = sheetOver(ball, 25);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  double deepest = 0, longest = 0;
  for (int step = 0; step < 90; ++step) {
    solver.step(1);
    const Measures now = measure(cloth, scene, solver.state());
    deepest = std::max(deepest, now.maxPenetration);
    longest = std::max(longest, now.maxStrain);
  }
  EXPECT_EQ(solver.divergence(), std::nullopt);
  EXPECT_LE(deepest, 1e-4 * ball.radius);
  EXPECT_LT(longest, 0.15) << "crumpling stretches springs";
  EXPECT_NEAR(solver.position(25 * 12 + 12).y, 0.95, 0.005) << "it lies on the ball";
  EXPECT_LT(solver.position(0).y, 0.85) << "and hangs down around it";
}

// On the floor, around a ball.
Scene drapedBall() {
  Scene scene = test::materialSheet(15, 15, 0.7, 0.7, *materialPreset("cotton"));
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 4;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::off;
  scene.colliders = {Sphere{.origin = {0.35, 0.84, 0.35}, .radius = 0.1, .friction = 0.4},
                     Plane{.point = {0, 0.64, 0}, .normal = {0, 1, 0}, .friction = 0.5}};
  chooseCounts(scene);
  return scene;
}

// Contacts are known when a step begins; and what held when the last one ended holds, as strongly.
TEST(ImplicitContact, LetsClothBeThatLiesOnABallAndTheFloor) {
  Scene scene = drapedBall();
  scene.solver.framesPerSec = 60;
  scene.solver.selfCollision = SelfCollision::contact;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(4 * 90);
  const ConvergenceCounts before = solver.convergenceCounts();
  solver.step(4 * 15);
  const ConvergenceCounts resting = solver.convergenceCounts() - before;
  EXPECT_EQ(resting.unconvergedSteps, 0u);
  EXPECT_LE(10 * resting.newtonSteps, 22 * resting.steps) << resting.newtonSteps;
}

// What friction remembers is a part of the state.
TEST(ImplicitContact, GoesOnFromASavedStateAsIfNothingHadHappened) {
  const Scene scene = drapedBall();
  const Cloth cloth(scene);
  CpuSolver<float> whole(cloth, scene), second(cloth, scene), forgetful(cloth, scene);
  whole.step(4 * 30);
  State state = parseStateFile(formatStateFile(whole.state()), cloth.particleCount(), "ball.state");
  EXPECT_EQ(state.elasticSlips.size(), cloth.particleCount());
  second.setState(state);
  state.elasticSlips.clear();
  forgetful.setState(state);
  for (CpuSolver<float>* solver : {&whole, &second, &forgetful}) solver->step(4);
  EXPECT_EQ(stateHash(second.state()), stateHash(whole.state()));
  EXPECT_NE(stateHash(forgetful.state()), stateHash(whole.state()));
  // So it is of a snapshot, which a later one leaves alone.
  const std::unique_ptr<Snapshot> kept = whole.snapshot();
  const auto later = [&] {
    whole.step(4);
    return stateHash(whole.state());
  };
  const std::uint64_t first = later();
  whole.restore(*kept);
  EXPECT_EQ(later(), first);
}

// A snapshot of before there was anything to touch knows of no friction.
TEST(ImplicitContact, GoesBackToBeforeThereWasAnythingToTouch) {
  const Scene touching = drapedBall();
  Scene free = touching;
  free.colliders.clear();
  const Cloth cloth(free);
  CpuSolver<float> solver(cloth, free), fresh(cloth, touching);
  const std::unique_ptr<Snapshot> start = solver.snapshot();
  solver.configure(touching);
  solver.step(4 * 30);
  solver.restore(*start);
  for (CpuSolver<float>* each : {&solver, &fresh}) each->step(4 * 30);
  EXPECT_EQ(stateHash(solver.state()), stateHash(fresh.state()));
}

// The step of cloth that may touch itself ends twice where nothing was cut short.
TEST(ImplicitContact, SticksAsWellWhereClothMayTouchItself) {
  Scene scene = drapedBall();
  scene.colliders.erase(scene.colliders.begin());
  scene.cloths[0].position.y -= 0.36;
  scene.gravity = {9.81 * std::sin(0.4), -9.81 * std::cos(0.4), 0};
  const Cloth cloth(scene);
  for (const SelfCollision mode : {SelfCollision::contact, SelfCollision::off}) {
    scene.solver.selfCollision = mode;
    CpuSolver<float> solver(cloth, scene);
    solver.step(4 * 15);
    const State state = solver.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i)
      ASSERT_NEAR(state.positions[i].x, cloth.positions()[i].x, 5e-6) << i;
  }
}

// Five particles above a plane at height 0 that is .3 below; they move down by the increment.
TEST(ImplicitContact, StopsAtPlanesThatDoNotHold) {
  constexpr std::size_t count = 5;
  cpu::ContactPlanes<double> planes;
  planes.resize(count);
  const auto plane = [&](std::size_t i, bool exists, bool holds) {
    const auto place = static_cast<std::ptrdiff_t>(i);
    cpu::put(planes.normals, place, exists ? Vec3d{0, 1, 0} : Vec3d{});
    planes.offsets[i] = exists ? -0.3 : 0;
    cpu::put(planes.blocks, place, cpu::Symmetric<double>{holds ? Vec3d{0, 7, 0} : Vec3d{}, {}});
  };
  plane(0, true, false), plane(1, true, false), plane(2, true, true), plane(3, false, false);
  plane(4, true, false);
  const Vec3d d{0.1, 0, 0}, e{0.2, -0.5, 0.4}, little{0.2, -0.25, 0.4};
  const auto heightAfter = [&](std::ptrdiff_t i, Vec3d increment) {
    const Vec3d stopped = cpu::stoppedAtPlane(planes, i, d, increment);
    EXPECT_EQ(stopped.x, increment.x) << "along the plane it goes on";
    EXPECT_EQ(stopped.z, increment.z);
    return stopped.y;
  };
  EXPECT_DOUBLE_EQ(heightAfter(0, e), -0.3) << "on the plane";
  EXPECT_EQ(heightAfter(1, little), -0.25) << "does not reach it";
  EXPECT_EQ(heightAfter(2, e), -0.5) << "the plane holds: the linear system knows it";
  EXPECT_EQ(heightAfter(3, e), -0.5) << "no plane";
  EXPECT_EQ(heightAfter(4, {0.2, 0.5, 0.4}), 0.5) << "leaves it";
}

TEST(ImplicitContact, LaysASheetOnAFlatCap) {
  for (const Collider& collider : std::initializer_list<Collider>{
           Cylinder{.origin = {0.5, 0.7, 0.5}, .height = 0.5, .radius = 0.25, .friction = 0.4},
           Cone{.origin = {0.5, 0.7, 0.5}, .height = 0.5, .radius = 0.35, .topRadius = 0.25}}) {
    const Scene scene = sheetOver(collider, 11);
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    double deepest = 0;
    for (int step = 0; step < 30; ++step) {
      solver.step(1);
      deepest = std::max(deepest, measure(cloth, scene, solver.state()).maxPenetration);
    }
    EXPECT_EQ(solver.divergence(), std::nullopt);
    EXPECT_LE(deepest, 3e-5) << typeOf(collider);
    double lowest = 1;
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      const Vec3d x = solver.position(i).cast<double>();
      if (std::hypot(x.x - 0.5, x.z - 0.5) < 0.25) lowest = std::min(lowest, x.y);
    }
    EXPECT_NEAR(lowest, 0.95, 1e-4) << "it lies on the cap of a " << typeOf(collider);
    EXPECT_LT(solver.position(0).y, 0.88) << "and hangs down around it";
  }
}

// Down a slope with mu = 0.3: a = g (sin - mu cos), and n steps of backward Euler go a h^2 n (n + 1) / 2.
double slide(double degrees, int steps) {
  Scene scene = sheetOver(Plane{.point = {0, 1, 0}, .normal = {0, 1, 0}, .friction = 0.3}, 5);
  scene.solver.tolerance = 1e-4;  // of a spacing of 250 mm
  const double angle = degrees * std::numbers::pi / 180;
  scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(steps);
  return solver.position(12).x - cloth.positions()[12].x;
}

TEST(ImplicitContact, RubsByCoulombsLaw) {
  const double angle = 30 * std::numbers::pi / 180, a = 9.81 * (std::sin(angle) - 0.3 * std::cos(angle));
  const double expected = a * 60 * 61 / 2 / 3600;
  EXPECT_NEAR(slide(30, 60), expected, 0.01 * expected);
  EXPECT_NEAR(slide(15, 60), 0, 1e-5) << "tan 15 degrees is less than 0.3";
}

}  // namespace
}  // namespace clothsim
