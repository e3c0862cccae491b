// The integrator bdf2: of second order where a step may look back, backward Euler where it may not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "export/formats.h"
#include "solver/cpu/cpu_solver.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

const Material stiffBoard{.density = 0.2, .stretch = 5000, .shear = 2000, .bend = 1, .damping = 0};

Scene sheetUnder(int columns, int rows, double width, double height, Integrator integrator) {
  Scene scene = test::materialSheet(columns, rows, width, height, stiffBoard);
  scene.solver.integrator = integrator;
  scene.solver.simulationSteps = 1;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  chooseCounts(scene);
  return scene;
}

// What a board that swings down from 60 degrees has left of its energy in its last swing before 4 s.
template <class Real>
double energyLeft(Integrator integrator) {
  Scene scene = sheetUnder(3, 17, 0.1, 1, integrator);
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].pinned = {GridSide::top};
  const double angle = std::numbers::pi / 3;
  scene.gravity = {0, -9.81 * std::cos(angle), 9.81 * std::sin(angle)};
  const Cloth cloth(scene);
  CpuSolver<Real> solver(cloth, scene);
  double mass = 0;
  const auto energy = [&] {
    double sum = mass = 0;
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      const Vec3d x = solver.position(i).template cast<double>(),
                  v = solver.velocity(i).template cast<double>();
      sum += cloth.massOf(i) * (0.5 * dot(v, v) - dot(scene.gravity, x));
      mass += cloth.massOf(i);
    }
    return sum;
  };
  const double start = energy(), fall = mass * 9.81 * 0.5 * (1 - std::cos(angle));
  solver.step(132);
  double most = -HUGE_VAL;  // over one period of 1.8 s
  for (int step = 0; step < 108; ++step) {
    solver.step(1);
    most = std::max(most, energy() - start);
  }
  return 1 + most / fall;
}

TEST(SecondOrder, KeepsASwingAlive) {
  EXPECT_GE(energyLeft<float>(Integrator::bdf2), 0.9);
  EXPECT_GE(energyLeft<double>(Integrator::bdf2), 0.9);
  EXPECT_LT(energyLeft<float>(Integrator::implicit), 0.6) << "which is why there is bdf2";
}

TEST(SecondOrder, DoesNotReboundWhereASheetDropsFlat) {
  for (const double height : {0.02, 0.2, 0.5}) {
    Scene scene = sheetUnder(17, 17, 0.5, 0.5, Integrator::bdf2);
    scene.cloths[0].material = materialPreset("cotton");
    scene.colliders = {Plane{.point = {0, 1 - height, 0}, .normal = {0, 1, 0}, .friction = 0.3}};
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(static_cast<int>(std::ceil(60 * std::sqrt(2 * height / 9.81))) + 1);
    double highest = 0;
    for (int step = 0; step < 30; ++step) {
      solver.step(1);
      for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
        highest = std::max(highest, solver.position(i).y - (1.0 - height));
    }
    EXPECT_LE(highest, 2e-3) << "from " << height << " m";
    EXPECT_GT(solver.convergenceCounts().secondOrderSteps, 15U) << "while it lies still";
  }
}

// Free fall, of which backward Euler's two steps at the start go too far.
TEST(SecondOrder, BeginsAnewAfterEveryEdit) {
  Scene scene = sheetUnder(5, 5, 1, 1, Integrator::bdf2);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const auto count = [&] { return solver.convergenceCounts().secondOrderSteps; };
  solver.step(60);
  EXPECT_EQ(count(), 58U);
  EXPECT_NEAR(solver.position(7).y - cloth.positions()[7].y, -9.81 / 2, 2 * 9.81 / 3600);
  State moved = solver.state();
  forgetHistory(moved);
  solver.setState(moved);
  solver.step(3);
  EXPECT_EQ(count(), 59U) << "a state that was changed has no step before";
  scene.camera.fov = 20;
  scene.render.gloss = 0.3;
  solver.configure(scene);
  solver.step(1);
  EXPECT_EQ(count(), 60U) << "which moves no cloth";
  scene.gravity.y = -5;
  solver.configure(scene);
  solver.step(3);
  EXPECT_EQ(count(), 61U);
  solver.setCuts({});
  solver.step(3);
  EXPECT_EQ(count(), 62U);
  solver.setPin(7, true);
  solver.step(3);
  EXPECT_EQ(count(), 63U);
}

// A strip with a cut swings from its top.
TEST(SecondOrder, GoesOnFromAStateAndASnapshotAsIfNothingHadHappened) {
  Scene scene = sheetUnder(5, 17, 0.2, 1, Integrator::bdf2);
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].pinned = {GridSide::top};
  scene.gravity = {0, -5, 8};
  const Cloth cloth(scene);
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {1.5, -1}, {1.5, 5.5});
  CpuSolver<float> whole(cloth, scene);
  whole.setCuts(cuts);
  whole.step(30);
  const State state = parseStateFile(formatStateFile(whole.state()), cloth.particleCount(), "a.state");
  EXPECT_EQ(state.histories.size(), 2 * cloth.particleCount());
  const std::unique_ptr<Snapshot> snapshot = whole.snapshot();
  const auto later = [](CpuSolver<float>& solver) {
    solver.step(10);
    return stateHash(solver.state());
  };
  const std::uint64_t expected = later(whole);
  whole.restore(*snapshot);
  EXPECT_EQ(later(whole), expected);
  CpuSolver<float> fromState(cloth, scene), fromSnapshot(cloth, scene), forgetful(cloth, scene);
  fromState.setState(state);
  EXPECT_EQ(later(fromState), expected);
  fromSnapshot.restore(*snapshot);
  EXPECT_EQ(later(fromSnapshot), expected);
  State moved = state;
  forgetHistory(moved);
  forgetful.setState(moved);
  EXPECT_NE(later(forgetful), expected);

  // In steps of another length, or of another integrator, it means nothing.
  scene.solver.simulationSteps = 2;
  CpuSolver<float> shorter(cloth, scene);
  shorter.setState(state);
  shorter.step(3);
  EXPECT_EQ(shorter.convergenceCounts().secondOrderSteps, 1u);
  scene.solver.integrator = Integrator::implicit;
  CpuSolver<float> implicit(cloth, scene);
  implicit.setState(state);
  EXPECT_TRUE(implicit.state().histories.empty());
}

// One row is let go after a while, another taken hold of again.
TEST(SecondOrder, GoesOnWhilePathsHoldPinsAndLetThemGo) {
  Scene scene = sheetUnder(5, 17, 0.2, 1, Integrator::bdf2);
  scene.cloths[0].pinned = {GridSide::top, GridSide::bottom};
  PinMotion released, held;
  released.pinned = {GridSide::top};
  released.keys = {{0, {}, {}, false}};
  released.release = 0.3;
  held.pinned = {GridSide::bottom};
  held.keys = {{0, {}, {}, false}, {0.1, {}, {}, true}, {0.4, {}, {}, false}};
  scene.cloths[0].pinMotion = {released, held};
  const Cloth cloth(scene);
  CpuSolver<float> whole(cloth, scene);
  const auto at = [&](CpuSolver<float>& solver, std::uint64_t step) {
    solver.step(static_cast<int>(step - solver.state().clock.step));
    return stateHash(solver.state());
  };
  CpuSolver<float> straight(cloth, scene);
  const std::uint64_t expected = at(straight, 40);
  for (const std::uint64_t step : {3u, 12u, 30u}) {
    (void)at(whole, step);
    CpuSolver<float> fromState(cloth, scene), fromSnapshot(cloth, scene);
    fromState.setState(whole.state());
    fromSnapshot.restore(*whole.snapshot());
    EXPECT_EQ(at(fromState, 40), expected) << step;
    EXPECT_EQ(at(fromSnapshot, 40), expected) << step;
  }
}

TEST(SecondOrder, LooksBackAtNoStepThatWasNotSolved) {
  Scene scene = sheetUnder(33, 33, 1, 1, Integrator::bdf2);
  scene.cloths[0].material = materialPreset("silk");
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{32, 0}};
  scene.solver.newtonSteps = 1;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(30);
  const ConvergenceCounts counts = solver.convergenceCounts();
  EXPECT_GE(counts.unconvergedSteps, 29U);
  EXPECT_LE(counts.secondOrderSteps, 1U);
}

}  // namespace
}  // namespace clothsim
