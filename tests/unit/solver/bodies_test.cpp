// Mesh colliders that deform: bodies of several shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.h"
#include "core/files.h"
#include "scene/pose.h"
#include "solver/cpu/shapes.h"
#include "solver/pin_paths.h"
#include "solver/step_params.h"
#include "support/lone_particle.h"
#include "support/temporary_folder.h"
#include "support/test_scenes.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using test::afterSteps;
using test::particleScene;

constexpr double RADIUS = 0.1;
constexpr int AROUND = 48, DOWN = 24;

// A ball whose points `place` takes elsewhere.
template <class Place>
std::string ballObj(Place place) {
  std::string text;
  for (int row = 0; row <= DOWN; ++row)
    for (int column = 0; column < AROUND; ++column) {
      if ((row == 0 || row == DOWN) && column > 0) continue;
      const double polar = std::numbers::pi * row / DOWN, azimuth = 2 * std::numbers::pi * column / AROUND;
      const Vec3d p = place(RADIUS * Vec3d{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                           std::sin(polar) * std::cos(azimuth)});
      text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
  const auto at = [](int row, int column) {
    const int number = row == 0 ? 1 : row == DOWN ? 2 + (DOWN - 1) * AROUND : 2 + (row - 1) * AROUND;
    return " " + std::to_string(row == 0 || row == DOWN ? number : number + column % AROUND);
  };
  for (int row = 0; row < DOWN; ++row)
    for (int column = 0; column < AROUND; ++column) {
      if (row > 0) text += "f" + at(row, column) + at(row + 1, column) + at(row, column + 1) + "\n";
      if (row + 1 < DOWN)
        text += "f" + at(row, column + 1) + at(row + 1, column) + at(row + 1, column + 1) + "\n";
    }
  return text;
}

class Bodies : public testing::Test {
 protected:
  template <class Place>
  void writeShape(int number, Place place) {
    writeFileAtomically(folder_ / ("ball_" + std::to_string(number) + ".obj"), ballObj(place));
  }
  // A ball that goes its own diameter along x from each shape to the next, two shapes a second.
  MeshCollider passingBall(int cells = 40) {
    for (int shape = 0; shape < 3; ++shape)
      writeShape(shape, [&](Vec3d p) { return p + Vec3d{2 * RADIUS * shape, 0, 0}; });
    MeshCollider ball{.file = (folder_ / "ball_%d.obj").string(), .cells = cells};
    ball.shapes = 3;
    ball.shapesPerSecond = 2;
    return ball;
  }
  static constexpr Vec3d velocity{4 * RADIUS, 0, 0};
  test::TemporaryFolder folder_;
};

TEST_F(Bodies, ThatPassAreWhereTheBallIsInBetweenAndGoAsFastAsItDoes) {
  const Scene scene = particleScene(passingBall(), 0.01);
  const ColliderSet colliders(scene);
  const double cell = (6 * RADIUS) / 40;
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform(-1.5 * RADIUS, 1.5 * RADIUS);
  for (const double time : {0.0, 0.05, 0.2, 0.25, 0.4, 0.5, 0.63, 0.98, 1.0}) {
    const Vec3d center = time * velocity;
    const auto params = colliders.params<double>(0, time - 0.01, time);
    const auto single = colliders.params<float>(0, time - 0.01, time);
    cpu::ShapeLaws<double> laws{colliders.distances()->data()};
    for (int i = 0; i < 300; ++i) {
      const Vec3d away{uniform(engine), uniform(engine), uniform(engine)}, p = center + away;
      const double exact = length(away) - RADIUS;
      const auto nearest = laws.nearestOnMesh(params, p);
      if (exact < 1.5 * cell && exact > -0.25 * RADIUS) {
        EXPECT_NEAR(nearest.distance, exact, 0.15 * cell) << time;
        EXPECT_GT(dot(nearest.normal, away) / length(away), 0.98) << time;
      }
      EXPECT_NEAR(colliders.distance(0, p, time), exact, 0.006 * RADIUS) << "the ball has flat faces";
      const auto rounded = cpu::nearestOnShape<COLLIDER_MESH>(single, p.cast<float>(), laws.distances);
      EXPECT_NEAR(static_cast<double>(rounded.distance), nearest.distance, 1e-5);
      const Vec3d way = laws.deformationNear(params, p);
      EXPECT_NEAR(length(way - (time > 0 ? 0.01 : 0.0) * velocity), 0, 1e-6) << "the step before " << time;
    }
  }
}

// As the ball that the files show does, and as the first of them does in motion.
TEST_F(Bodies, PushAParticleAsTheSameMeshInMotionDoes) {
  const MeshCollider body = passingBall();
  const Motion motion{.keys = {{0, {0, 0, 0}, {}}, {1, velocity, {}}}};
  const std::vector<Collider> others{Sphere{.radius = RADIUS, .motion = motion},
                                     MeshCollider{.file = body.fileOf(0), .cells = 16, .motion = motion}};
  const double cell = (6 * RADIUS) / 40;
  for (const double friction : {0.0, 0.5}) {
    const auto end = [&](Collider collider) {
      std::visit([&](auto& shape) { shape.friction = friction; }, collider);
      Scene scene = particleScene(collider, 1e-3);
      scene.gravity = {0, 0, 0};
      return afterSteps(scene, {{RADIUS + 0.02, 0.03, 0.01}, {0, 0, 0}}, 200).x;
    };
    const Vec3d x = end(body);
    EXPECT_GT(x.x, RADIUS + 0.03) << "it was pushed";
    for (const Collider& other : others)
      EXPECT_NEAR(length(x - end(other)), 0, 0.3 * cell) << friction << " " << typeOf(other);
  }
}

// Where limbs bend, the field of displacements is that of a place nearby. The surface itself is the oracle.
TEST(WalkingFigure, IsFoundWithinAPartOfACellOnTheWaysBetweenItsShapes) {
  MeshCollider walk{.file = "assets/meshes/walk/walk_%02d.obj", .cells = 72};
  walk.shapes = 3;
  walk.firstShape = 6;  // a heel comes down, the other foot kicks off
  walk.shapesPerSecond = 1;
  const Scene scene = particleScene(walk, 0.01);
  const ColliderSet colliders(scene);
  const auto grid = distanceGridOf(walk);
  cpu::ShapeLaws<double> laws{colliders.distances()->data()};
  double atAShape = 0;
  for (const double time : {0.0, 0.25, 0.5, 0.75, 1.5}) {
    const auto params = colliders.params<double>(0, time, time);
    double worst = 0, sum = 0;
    const std::vector<Vec3d> points = grid->at(walk.momentAt(time))->mesh.points;
    for (const Vec3d p : points) {
      const double off = std::abs(laws.nearestOnMesh(params, p).distance);
      worst = std::max(worst, off);
      sum += off;
    }
    if (time == 0) atAShape = sum;
    EXPECT_LT(worst, 0.6 * grid->cell()) << time;
    EXPECT_LT(sum, 1.05 * atAShape) << time << ": the ways add next to nothing to the error of the grid";
  }
}

// Distances that are interpolated between exact samples were above 0 on 85 % of the surface, by up to 12 mm
// at the toes, and cloth sank in by as much.
TEST(WalkingFigure, IsEnclosedByItsSampledDistancesOnItsWholeWay) {
  MeshCollider walk{.file = "assets/meshes/walk/walk_%02d.obj", .cells = 64};
  walk.shapes = 24;
  walk.shapesLoop = true;
  walk.shapesPerSecond = 1;
  const Scene scene = particleScene(walk, 0.01);
  const ColliderSet colliders(scene);
  const auto grid = distanceGridOf(walk);
  cpu::ShapeLaws<double> laws{colliders.distances()->data()};
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = -1, sum = 0;
  int points = 0, outside = 0;
  for (int shape = 0; shape < walk.shapes; ++shape)
    for (const double part : {0.0, 0.1, 0.4, 0.5, 0.85}) {
      const auto params = colliders.params<double>(0, shape + part, shape + part);
      const auto now = grid->at(walk.momentAt(shape + part));
      for (std::size_t triangle = 0; triangle < now->mesh.triangles.size(); ++triangle) {
        const double a = uniform(engine), b = (1 - a) * uniform(engine);
        const double distance =
            laws.nearestOnMesh(params, placeOf(now->mesh, {triangle, {a, b, 1 - a - b}})).distance;
        worst = std::max(worst, distance);
        sum += distance;
        outside += distance > 2e-5 ? 1 : 0;
        ++points;
      }
    }
  EXPECT_LT(worst, 2e-4) << "between the points at which it was made so";
  EXPECT_LT(outside, 1e-3 * points);
  EXPECT_GT(sum / points, -2e-3) << "and is not much thicker than it is";
}

// A particle that lies on top of a ball that goes sideways under it, and sticks.
TEST_F(Bodies, CarryWhatSticksToThemAlong) {
  MeshCollider body = passingBall();
  body.friction = 1;
  Scene scene = particleScene(body, 0.01);
  scene.gravity = {0, 0, 0};
  const test::LoneParticle end = afterSteps(scene, {{0, RADIUS + 1e-4, 0}, {0, -0.1, 0}}, 1);
  EXPECT_NEAR(end.x.x, 0.01 * velocity.x, 1e-4);
  EXPECT_NEAR(end.v.x, velocity.x, 1e-2) << "as fast as the ball in the end";
  EXPECT_NEAR(end.x.y, RADIUS, 1e-3);
}

TEST_F(Bodies, RepeatOrStayAsTheirKeysSay) {
  MeshCollider body = passingBall();
  body.shapesStart = 1;
  EXPECT_EQ(body.momentAt(body.progressAt(0)), (ShapeMoment{0, 1, 0})) << "before its start";
  EXPECT_EQ(body.momentAt(body.progressAt(1.75)), (ShapeMoment{1, 2, 0.5}));
  EXPECT_EQ(body.momentAt(body.progressAt(9)), (ShapeMoment{1, 2, 1})) << "after its end";
  body.shapesLoop = true;
  EXPECT_EQ(body.momentAt(body.progressAt(2.25)), (ShapeMoment{2, 0, 0.5})) << "on the way to the first";
  EXPECT_EQ(body.momentAt(body.progressAt(0.75)), (ShapeMoment{2, 0, 0.5})) << "before its start, too";
  EXPECT_NEAR(body.progressAt(2.6) - body.progressAt(2.4), 0.4, 1e-12) << "over the end";
}

// Two shapes of which the second one is turned: a pin above the ball turns with the triangle below it.
TEST_F(Bodies, TakePinsAlongWithTheTrianglesBelowThem) {
  const Matrix3 turn = rotationMatrix({0, 0, 30});
  writeShape(0, [](Vec3d p) { return p; });
  writeShape(1, [&](Vec3d p) { return rotate(turn, p) + Vec3d{0, 0, 0.02}; });
  MeshCollider body{
      .file = (folder_ / "ball_%d.obj").string(), .origin = {0, -RADIUS - 0.01, 0}, .cells = 24};
  body.shapes = 2;
  body.shapesPerSecond = 10;
  Scene scene = test::sheetScene(3);
  scene.colliders = {body};
  scene.cloths[0].pinned = {GridPoint{1, 1}, GridPoint{0, 0}};
  scene.cloths[0].pinMotion = {PinMotion{}};
  scene.cloths[0].pinMotion[0].collider = 0;
  const Cloth cloth(scene);
  const PinPaths pins = makePinPaths(scene, cloth);
  ASSERT_EQ(pins.paths.size(), 3u) << "the motion's, and one for each pin";
  for (const std::uint32_t point : {0u, 4u}) {
    const PinPath& path = pins.paths[pins.numbers[point] - 1];
    const Vec3d start = cloth.positions()[point];
    EXPECT_EQ(path.center, start);
    const auto still = makePinMotionParams<double>(path, 0, 0.01),
               moved = makePinMotionParams<double>(path, 5, 0.01);
    EXPECT_NEAR(length({still.translationX, still.translationY, still.translationZ}), 0, 1e-12);
    const Vec3d expected = body.origin + rotate(turn, start - body.origin) + Vec3d{0, 0, 0.02};
    const Vec3d place = start + Vec3d{moved.translationX, moved.translationY, moved.translationZ};
    EXPECT_NEAR(length(place - expected), 0, 5e-4) << "the file has micrometres, over a small triangle";
    EXPECT_NEAR(moved.rotationXY, turn[0].y, 5e-4);
  }
}

TEST_F(Bodies, ThatAreWrongGetAMessageThatSaysWhatToDo) {
  MeshCollider body = passingBall();
  const auto message = [&](const MeshCollider& collider) {
    return test::messageThrownBy<SceneError>([&] { (void)loadShapes(collider); });
  };
  body.shapes = 4;
  EXPECT_NE(message(body).find("ball_3.obj"), std::string::npos) << message(body);
  EXPECT_NE(message(body).find("shape 4 of 4"), std::string::npos) << message(body);
  writeFileAtomically(folder_ / "ball_3.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(message(body).find("ball_3.obj: expected 1106 points and 2208 triangles as in"),
            std::string::npos)
      << message(body);
  std::string other = ballObj([](Vec3d p) { return p; });
  other.replace(other.find("f 1 2 3"), 7, "f 1 3 2");
  writeFileAtomically(folder_ / "ball_3.obj", other);
  EXPECT_NE(message(body).find("in the same order, found others"), std::string::npos) << message(body);
  body.shapes = 3;
  body.cells = 100;
  const std::string far = test::messageThrownBy<SceneError>([&] { (void)distanceGridOf(body); });
  EXPECT_NE(far.find("ball_0.obj: to the next shape a point goes 0.2 m, expected at most 16 cells"),
            std::string::npos)
      << far;
}

TEST_F(Bodies, CountTowardsTheBudgetOfSamples) {
  Scene scene;
  scene.colliders = {passingBall(16)};
  const std::size_t samples = ColliderSet(scene).distances()->size();
  // 16 + 5 samples along x, 6 + 5 along y and z; of displacements 11 and 6.
  EXPECT_EQ(samples, 3u * 21 * 11 * 11 + 2u * 3 * 11 * 6 * 6);
  EXPECT_THROW((void)ColliderSet(scene, samples - 1), SceneError);
}

}  // namespace
}  // namespace clothsim
