// Pins that follow a path: where they are at a time, by the formula; what must not move; who feels them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cloth/pins.h"
#include "measure/measure.h"
#include "scene/pose.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/synchronized.h"
#include "solver/pin_paths.h"
#include "support/compared_scenes.h"

namespace clothsim {
namespace {

using test::sheetScene;

PinMotion::Key key(double t, std::optional<Vec3d> position, Vec3d rotation = {0, 0, 0}) {
  return {.t = t, .position = position, .rotation = rotation};
}

// 5 x 5 points 0.25 m apart at y = 1 m, in steps of 1 ms, the left column moving.
Scene leftColumnScene(PinMotion motion) {
  Scene scene = sheetScene(5);
  scene.solver.framesPerSec = 1000;
  scene.solver.simulationSteps = 1;
  scene.cloths[0].ks = 10;
  scene.cloths[0].pinned = {GridSide::left, GridSide::right};
  motion.pinned = {GridSide::left};
  scene.cloths[0].pinMotion = {std::move(motion)};
  return scene;
}

void expectNear(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

template <class Real>
void expectOnPath(const CpuSolver<Real>& solver, const Cloth& cloth, Vec3d center, Vec3d degrees,
                  double tolerance) {
  const Vec3d start{0, 1, 0.5};  // the mean of the left column
  for (int row = 0; row < 5; ++row) {
    const std::uint32_t pin = cloth.pieces()[0].particle(0, row);
    const Vec3d expected = center + rotate(rotationMatrix(degrees), cloth.positions()[pin] - start);
    expectNear(solver.position(pin).template cast<double>(), expected, tolerance);
  }
}

TEST(PinMotion, TakesPinsWhereTheFormulaSays) {
  const Scene scene =
      leftColumnScene({.keys = {key(0, std::nullopt), key(0.1, Vec3d{0.1, 1.2, 0.6}, {0, 90, 0}),
                                key(0.2, Vec3d{0.1, 1.4, 0.6}, {720, 90, 0})},
                       .loop = false,
                       .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  CpuSolver<float> single(cloth, scene);
  const auto stepTo = [&](std::uint64_t step) {
    solver.step(static_cast<int>(step - solver.stepIndex()));
    single.step(static_cast<int>(step - single.stepIndex()));
  };
  const auto expectAt = [&](std::uint64_t step, Vec3d center, Vec3d degrees) {
    stepTo(step);
    expectOnPath(solver, cloth, center, degrees, 1e-12);
    expectOnPath(single, cloth, center, degrees, 1e-6);
  };
  expectAt(50, {0.05, 1.1, 0.55}, {0, 45, 0});
  expectAt(100, {0.1, 1.2, 0.6}, {0, 90, 0});
  expectAt(125, {0.1, 1.25, 0.6}, {180, 90, 0});
  expectAt(150, {0.1, 1.3, 0.6}, {360, 90, 0});
  expectAt(200, {0.1, 1.4, 0.6}, {720, 90, 0});
  expectAt(5000, {0.1, 1.4, 0.6}, {720, 90, 0});  // and stands still
  EXPECT_EQ(single.velocity(0), (Vec3f{0, 0, 0}));
}

// A cubic path goes through its keys, without a jump of its velocity, and is at rest at its ends.
TEST(PinMotion, FollowsCubicPathsWithoutKinks) {
  Motion motion;
  motion.interpolation = Interpolation::cubic;
  motion.keys = {{0, {0, 0, 0}, {0, 0, 0}},
                 {0.5, {1, 2, 0}, {0, 90, 0}},
                 {0.8, {3, 1, 1}, {0, 90, 45}},
                 {2, {0, 0, 2}, {10, 0, 0}}};
  const auto velocity = [&](double t, double side) {
    constexpr double h = 1e-5;
    return (1 / h) * (side * (keyAt(motion, t + side * h).position - keyAt(motion, t).position));
  };
  for (const Motion::Key& key : motion.keys) {
    expectNear(keyAt(motion, key.t).position, key.position, 1e-12);
    expectNear(keyAt(motion, key.t).rotation, key.rotation, 1e-12);
    expectNear(velocity(key.t, 1), velocity(key.t, -1), 2e-3);
  }
  expectNear(velocity(0, 1), {0, 0, 0}, 1e-3);
  expectNear(velocity(0.5, 1), (1 / 0.8) * Vec3d{3, 1, 1}, 1e-3);
  motion.loop = true;
  motion.keys.back().position = motion.keys.front().position;
  expectNear(velocity(1e-9, 1), velocity(2 - 1e-9, -1), 2e-3);
  motion.interpolation = Interpolation::linear;
  expectNear(keyAt(motion, 0.25).position, {0.5, 1, 0}, 1e-12);
}

// A ball that is not at the pins' place, and is turned at the start.
TEST(PinMotion, MovesPinsWithACollider) {
  PinMotion motion;
  motion.collider = 1;
  Scene scene = leftColumnScene(motion);
  Sphere ball;
  ball.origin = {0, 5, 0};
  ball.radius = 0.1;
  scene.colliders = {ball, ball};
  auto& turning = std::get<Sphere>(scene.colliders[1]);
  turning.motion.emplace();
  turning.motion->keys = {{0, {0.2, 3, 0}, {0, 0, 30}}, {0.05, {0.4, 3.1, 0}, {0, 0, 75}}};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(40);  // 0.04 s: four fifths of the way
  const Matrix3 turn = rotationMatrix({0, 0, 36});
  for (int row = 0; row < 5; ++row) {
    const std::uint32_t pin = cloth.pieces()[0].particle(0, row);
    expectNear(solver.position(pin),
               Vec3d{0.36, 3.08, 0} + rotate(turn, cloth.positions()[pin] - Vec3d{0.2, 3, 0}), 1e-9);
  }
}

TEST(PinMotion, ReleasesPinsAtATimeForGood) {
  for (const bool moves : {false, true}) {
    PinMotion motion;
    if (moves) motion.keys = {key(0, std::nullopt), key(1, Vec3d{0, 2, 0.5})};
    motion.release = 0.02;
    const Scene scene = leftColumnScene(motion);
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    const std::uint32_t pin = cloth.pieces()[0].particle(0, 2);
    solver.step(20);
    const Vec3d held = solver.position(pin);
    expectNear(held, {0, moves ? 1.02 : 1, 0.5}, 1e-6);
    EXPECT_EQ(solver.state().positions[pin].w, 0);
    solver.step(60);
    EXPECT_GT(solver.state().positions[pin].w, 0);
    EXPECT_LT(solver.position(pin).y, held.y + 0.06 * (moves ? 1 : 0) - 0.5 * 9.8 * 0.06 * 0.06 * 0.5)
        << "falls";
  }
}

TEST(PinMotion, BeginsAgainInALoop) {
  const Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(0.1, Vec3d{0, 1.3, 0.5})}, .loop = true, .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(40);
  expectOnPath(solver, cloth, {0, 1.12, 0.5}, {0, 0, 0}, 1e-12);
  solver.step(3000);
  expectOnPath(solver, cloth, {0, 1.12, 0.5}, {0, 0, 0}, 1e-12);
}

TEST(PinMotion, TurnsPinsAboutTheirCentreWithoutStretchingThem) {
  const Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(1, std::nullopt, {3600, 0, 0})}, .loop = false, .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  for (int step = 0; step < 1000; step += 37) {
    solver.step(37);
    Vec3d mean{0, 0, 0};
    for (std::uint32_t row = 0; row < 5; ++row) mean = mean + 0.2 * solver.position(5 * row).cast<double>();
    expectNear(mean, {0, 1, 0.5}, 1e-7);
    const Vec3d span = solver.position(20).cast<double>() - solver.position(0).cast<double>();
    EXPECT_NEAR(std::sqrt(dot(span, span)), 1, 1e-6);
  }
}

TEST(PinMotion, GivesPinsTheVelocityOfTheStep) {
  const Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(1, Vec3d{0, 3, 0.5})}, .loop = false, .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(10);
  expectNear(solver.velocity(10), {0, 2, 0}, 1e-9);
  CpuSolver<float> single(cloth, scene);
  single.step(9);
  const Vec3f before = single.position(10);
  single.step(1);
  EXPECT_EQ(single.velocity(10).y, 1000.0f * (single.position(10).y - before.y))
      << "to the bit: friction and exports see what was moved";
}

TEST(PinMotion, LeavesOtherPinsUnmovedByABitAndWaitsForTheFirstKey) {
  const Scene scene =
      leftColumnScene({.keys = {key(0.5, std::nullopt), key(1, Vec3d{0.2, 1.1, 0.3}, {0, 0, 80})},
                       .loop = false,
                       .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(499);
  for (std::uint32_t row = 0; row < 5; ++row) {
    EXPECT_EQ(solver.position(5 * row), startPosition<float>(cloth, 5 * row));
    EXPECT_EQ(solver.velocity(5 * row), (Vec3f{0, 0, 0}));
  }
  solver.step(300);
  for (std::uint32_t row = 0; row < 5; ++row) {
    EXPECT_NE(solver.position(5 * row), startPosition<float>(cloth, 5 * row));
    EXPECT_EQ(solver.position(5 * row + 4), startPosition<float>(cloth, 5 * row + 4));
    EXPECT_EQ(solver.velocity(5 * row + 4), (Vec3f{0, 0, 0}));
  }
}

// A thousand turns: where a rotation added up from step to step would have shrunk or grown the column.
TEST(PinMotion, DoesNotDrift) {
  Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(20, std::nullopt, {360'000, 0, 0})}, .loop = false, .pinned = {}});
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(20'000);
  expectOnPath(solver, cloth, {0, 1, 0.5}, {0, 0, 0}, 1e-6);
}

TEST(PinMotion, IsLiveAndEndsWhereThePinsAre) {
  const Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(1, Vec3d{0, 2, 0.5})}, .loop = false, .pinned = {}});
  Scene still = scene;
  still.cloths[0].pinMotion.clear();
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, still);
  solver.step(10);
  EXPECT_EQ(solver.position(0), startPosition<float>(cloth, 0));
  solver.configure(scene);
  solver.step(90);
  EXPECT_NEAR(solver.position(0).y, 1.1, 1e-6);
  solver.configure(still);
  const Vec3f left = solver.position(0);
  solver.step(100);
  EXPECT_EQ(solver.position(0), left);
  EXPECT_EQ(solver.velocity(0), (Vec3f{0, 0, 0}));
}

TEST(PinMotion, AddsNothingToTheKineticEnergy) {
  Scene scene = leftColumnScene(
      {.keys = {key(0, std::nullopt), key(1, Vec3d{0, 100, 0.5})}, .loop = false, .pinned = {}});
  scene.cloths[0].pinned = {GridRange{{0, 0}, {4, 4}}};
  scene.cloths[0].pinMotion[0].pinned.clear();
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(5);
  EXPECT_GT(solver.velocity(0).y, 90);
  EXPECT_EQ(measure(cloth, scene, synchronized(cloth, scene, solver.state())).kineticEnergy, 0);
}

// All corners of a triangle moved through still air: the force of the relative wind, by hand.
TEST(PinMotion, IsFeltByTheWind) {
  Scene scene = sheetScene(2);
  scene.gravity = {0, 0, 0};
  scene.wind = Wind{.velocity = {0, 0, 0}, .gust = {}, .drag = 1.2, .lift = 0, .airDensity = 1.2};
  scene.cloths[0].pinned = {GridSide::top, GridSide::bottom};
  scene.cloths[0].pinMotion = {
      {.keys = {key(0, std::nullopt), key(1, Vec3d{0.5, 3, 0.5})}, .loop = false, .pinned = {}}};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(3);
  Vec3d total{0, 0, 0};
  for (const Vec3d force : solver.forces()) total = total + force;
  EXPECT_NEAR(total.y, -0.5 * 1.2 * 1.2 * 1 * 2 * 2, 1e-9);  // half rho C_d A v^2 against the motion
}

// The left column is free at first, is taken at 0.1 s, carried 0.3 m upwards, and let go at 0.5 s.
Scene handScene() {
  PinMotion hand{.keys = {key(0, std::nullopt), key(0.1, std::nullopt), key(0.2, Vec3d{0, 1.3, 0.5}),
                          key(0.5, Vec3d{0, 1.3, 0.5})},
                 .loop = false,
                 .pinned = {}};
  hand.keys.front().free = hand.keys.back().free = true;
  return leftColumnScene(std::move(hand));
}

template <class Real>
double meanHeight(const CpuSolver<Real>& solver) {
  double sum = 0;
  for (std::uint32_t row = 0; row < 5; ++row) sum += 0.2 * static_cast<double>(solver.position(5 * row).y);
  return sum;
}

TEST(PinMotion, TakesHoldOfFreePinsAndLetsThemGo) {
  const Scene scene = handScene();
  Scene loose = scene;
  loose.cloths[0].pinned = {GridSide::right};
  loose.cloths[0].pinMotion.clear();
  const Cloth cloth(scene), looseCloth(loose);
  CpuSolver<double> solver(cloth, scene), free(looseCloth, loose);
  solver.step(100);
  free.step(100);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    ASSERT_EQ(solver.position(i), free.position(i)) << "until then no pin holds it";
  const Vec3d before = solver.position(0);
  ASSERT_LT(before.y, 0.99);
  solver.step(1);
  const double taken = 1 - std::exp(-0.001 / HAND_TIME);
  expectNear(solver.position(0), before + taken * (Vec3d{0, 1, 0} + Vec3d{0, 0.003, 0} - before), 1e-9);
  solver.step(398);
  EXPECT_NEAR(meanHeight(solver), 1.3, 0.3 * std::exp(-0.3 / HAND_TIME));
  EXPECT_EQ(solver.state().positions[0].w, 0);
  solver.step(1);
  const Vec3d thrown = solver.velocity(0);
  solver.step(1);
  EXPECT_GT(solver.state().positions[0].w, 0);
  EXPECT_NEAR(solver.velocity(0).y, thrown.y, 0.5) << "it goes on from the velocity of the hand";
  solver.step(200);
  EXPECT_LT(meanHeight(solver), 1.25) << "and falls";
}

TEST(PinMotion, NeverPullsAFreePinFasterThanAHand) {
  Scene scene = handScene();
  scene.cloths[0].pinMotion[0].keys[1].position = Vec3d{0, 9, 0.5};
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  solver.step(100);
  for (int step = 0; step < 50; ++step) {
    solver.step(1);
    const Vec3d v = solver.velocity(0);
    ASSERT_NEAR(std::sqrt(dot(v, v)), HAND_SPEED, 1e-6);
  }
}

// A snapshot between two keys goes on as the run that it was taken from.
TEST(PinMotion, GoesOnFromASnapshotWithAFreePin) {
  const Scene scene = handScene();
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(90);
  const std::unique_ptr<Snapshot> early = solver.snapshot();
  solver.step(300);
  const State held = solver.state();
  solver.step(300);
  solver.restore(*early);
  solver.step(300);
  const State again = solver.state();
  for (std::size_t i = 0; i < held.positions.size(); ++i) {
    EXPECT_EQ(vectorOf(again.positions[i]), vectorOf(held.positions[i]));
    EXPECT_EQ(again.positions[i].w, held.positions[i].w);
  }
}

TEST(PinMotionOfPoints, NumbersPointsByTheMotionThatMovesThem) {
  const Scene scene = parseScene(
      R"({"cloth": {"num_width_points": 3, "num_height_points": 3, "pinned": ["left", "bottom", [2, 0]],
          "pin_motion": [{"keys": [{"t": 0}], "pinned": [[2, 0]]},
                         {"keys": [{"t": 0}], "pinned": [{"from": [0, 1], "to": [0, 2]}]}]}})",
      "test");
  constexpr int none = NO_MOTION;
  EXPECT_EQ(pinMotionOfPoints(scene.cloths[0]),
            (std::vector<int>{none, none, 0, 1, none, none, 1, none, none}));
}

TEST(PinPaths, CountOnFromClothToCloth) {
  const Scene scene = test::twoClothsWithPinMotion(test::vertical(sheetScene(9)));
  const Cloth cloth(scene);
  const PinPaths pins = makePinPaths(scene, cloth);
  ASSERT_EQ(pins.paths.size(), 4U);
  ASSERT_EQ(pins.numbers.size(), cloth.particleCount());
  EXPECT_EQ(pins.numbers[cloth.pieces()[0].particle(8, 0)], 2U);
  EXPECT_EQ(pins.numbers[cloth.pieces()[0].particle(8, 8)], 0U) << "a pin that stays";
  EXPECT_EQ(pins.numbers[cloth.pieces()[1].particle(3, 8)], 4U);
  EXPECT_EQ(pins.paths[3].center, cloth.positions()[cloth.pieces()[1].particle(3, 8)]);
}

TEST(PinPaths, AreEmptyWithoutMotions) {
  const Scene scene = test::vertical(sheetScene(9));
  EXPECT_TRUE(makePinPaths(scene, Cloth(scene)).numbers.empty());
  EXPECT_FALSE(dependsOnTime(scene));
  EXPECT_TRUE(dependsOnTime(test::withPinMotion(scene)));
}

TEST(FindPinConflict, SeesWhatTwoMotionsShareThoughEachNamesItsPinsTwice) {
  ClothSettings cloth;
  cloth.numWidthPoints = cloth.numHeightPoints = 100;
  cloth.pinned = {GridSide::left, GridSide::bottom};
  cloth.pinMotion = {PinMotion{{}, false, {GridSide::left, GridPoint{0, 7}, GridSide::left}},
                     PinMotion{{}, false, {GridRange{{1, 99}, {9, 99}}, GridRange{{3, 99}, {99, 99}}}}};
  EXPECT_EQ(findPinConflict(cloth), std::nullopt);
  cloth.pinMotion[1].pinned.push_back(GridSide::bottom);
  const auto conflict = findPinConflict(cloth);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->point, "[0, 99]");
  EXPECT_EQ(conflict->motion, 1u);
  EXPECT_EQ(conflict->pin, 2u);
  EXPECT_EQ(conflict->otherMotion, 0u);
}

}  // namespace
}  // namespace clothsim
