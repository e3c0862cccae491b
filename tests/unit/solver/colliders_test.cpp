// Colliders of every shape: distances against brute force, the two laws of friction, nothing gets through.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "measure/measure.h"
#include "scene/pose.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/shapes.h"
#include "support/lone_particle.h"

namespace clothsim {
namespace {

using test::afterSteps;
using test::particleScene;
using test::sheetScene;

// --- Distances

// Every shape is what lies within a radius of its skeleton. Sampled densely, a skeleton gives the distance by
// brute force.
struct Skeleton {
  std::vector<Vec3d> points;
  double radius = 0;
  Vec3d solid{0, 0, 0};  // half sizes of a box that is filled
};

Skeleton capsuleSkeleton(const Capsule& capsule) {
  Skeleton skeleton{{}, capsule.radius};
  for (int i = 0; i <= 2000; ++i) skeleton.points.push_back({0, (i / 2000.0 - 0.5) * capsule.length, 0});
  return skeleton;
}

Skeleton torusSkeleton(const Torus& torus) {
  Skeleton skeleton{{}, torus.tubeRadius};
  for (int i = 0; i < 5000; ++i) {
    const double a = 2 * std::numbers::pi * i / 5000;
    skeleton.points.push_back({torus.radius * std::cos(a), 0, torus.radius * std::sin(a)});
  }
  return skeleton;
}

Skeleton boxSkeleton(const Box& box) {
  Skeleton skeleton{{}, box.rounding, 0.5 * box.size - box.rounding * Vec3d{1, 1, 1}};
  const Vec3d h = skeleton.solid;
  constexpr int n = 200;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (const double side : {-1.0, 1.0}) {
        const double a = 2.0 * i / n - 1, b = 2.0 * j / n - 1;
        skeleton.points.push_back({side * h.x, a * h.y, b * h.z});
        skeleton.points.push_back({a * h.x, side * h.y, b * h.z});
        skeleton.points.push_back({a * h.x, b * h.y, side * h.z});
      }
  return skeleton;
}

double bruteForceDistance(const Skeleton& skeleton, Vec3d p) {
  double least = 1e30;
  for (const Vec3d q : skeleton.points) least = std::min(least, dot(p - q, p - q));
  const Vec3d h = skeleton.solid;
  const bool filled = std::abs(p.x) < h.x && std::abs(p.y) < h.y && std::abs(p.z) < h.z;
  return (filled ? -1 : 1) * std::sqrt(least) - skeleton.radius;
}

// A surface around y by the line that it is made of, in the half-plane of positive x.
Skeleton lineSkeleton(const std::vector<Vec3d>& corners) {
  Skeleton skeleton;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    for (int i = 0; i <= 500; ++i)
      skeleton.points.push_back(corners[k] + (i / 500.0) * (corners[k + 1] - corners[k]));
  return skeleton;
}

template <std::uint32_t type>
void expectDistances(const Collider& collider, const Skeleton& skeleton) {
  const Scene scene = particleScene(collider, 0.01);
  const ColliderSet colliders(scene);
  const auto params = colliders.params<double>(0, 0, 0);
  const auto single = colliders.params<float>(0, 0, 0);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  for (int i = 0; i < 300; ++i) {
    const Vec3d p{uniform(engine), uniform(engine), uniform(engine)};
    const auto nearest = cpu::nearestOnShape<type>(params, p);
    EXPECT_NEAR(nearest.distance, bruteForceDistance(skeleton, p), 2e-3);
    EXPECT_NEAR(length(nearest.normal), 1, 1e-12);
    // The way back along the normal ends on the surface, whatever the side.
    const auto there = cpu::nearestOnShape<type>(params, p - nearest.distance * nearest.normal);
    EXPECT_NEAR(there.distance, 0, 1e-12);
    const auto rounded = cpu::nearestOnShape<type>(single, p.cast<float>());
    EXPECT_NEAR(static_cast<double>(rounded.distance), nearest.distance, 3e-7);
  }
}

// Whether a point is inside decides measuring's own formula: the sign of a sampled surface is unknown.
template <std::uint32_t type>
void expectRevolvedDistances(const Collider& collider, const std::vector<Vec3d>& corners) {
  const Skeleton surface = lineSkeleton(corners);
  const ColliderSet colliders(particleScene(collider, 0.01));
  const auto params = colliders.params<double>(0, 0, 0);
  const auto single = colliders.params<float>(0, 0, 0);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  for (int i = 0; i < 300; ++i) {
    const Vec3d p{uniform(engine), uniform(engine), uniform(engine)};
    const auto nearest = cpu::nearestOnShape<type>(params, p);
    EXPECT_NEAR(std::abs(nearest.distance), bruteForceDistance(surface, {std::hypot(p.x, p.z), p.y, 0}),
                2e-3);
    EXPECT_NEAR(length(nearest.normal), 1, 1e-12);
    EXPECT_NEAR(colliders.distance(0, p - nearest.distance * nearest.normal), 0, 1e-12);
    const auto rounded = cpu::nearestOnShape<type>(single, p.cast<float>());
    EXPECT_NEAR(static_cast<double>(rounded.distance), nearest.distance, 3e-7);
  }
}

TEST(Shapes, HaveTheDistancesOfDenselySampledSkeletons) {
  const Capsule capsule{.length = 0.5, .radius = 0.2};
  const Torus torus{.radius = 0.3, .tubeRadius = 0.1};
  const Box box{.size = {0.6, 0.4, 0.5}, .rounding = 0.05}, sharp{.size = {0.6, 0.4, 0.5}, .rounding = 0};
  expectDistances<COLLIDER_CAPSULE>(capsule, capsuleSkeleton(capsule));
  expectDistances<COLLIDER_TORUS>(torus, torusSkeleton(torus));
  expectDistances<COLLIDER_BOX>(box, boxSkeleton(box));
  expectDistances<COLLIDER_BOX>(sharp, boxSkeleton(sharp));
  const Cylinder cylinder{.height = 0.5, .radius = 0.3};
  expectRevolvedDistances<COLLIDER_CYLINDER>(cylinder, {{0, 0.25}, {0.3, 0.25}, {0.3, -0.25}, {0, -0.25}});
  const Cone pointed{.height = 0.5, .radius = 0.3}, bucket{.height = 0.4, .radius = 0.1, .topRadius = 0.4};
  expectRevolvedDistances<COLLIDER_CONE>(pointed, {{0, 0.25}, {0.3, -0.25}, {0, -0.25}});
  expectRevolvedDistances<COLLIDER_CONE>(bucket, {{0, 0.2}, {0.4, 0.2}, {0.1, -0.2}, {0, -0.2}});
}

// The law of the passes, and the one that measuring has for itself.
struct Distances {
  double passes, measuring;
};
Distances distancesOf(const Collider& collider, Vec3d ownPoint) {
  const ColliderSet colliders(particleScene(collider, 0.01));
  const auto params = colliders.params<double>(0, 0, 0);
  Distances distances{.passes = 1e30, .measuring = colliders.distance(0, ownPoint)};
#define IN_PASSES(number, Struct, law) \
  if (params.type == number)           \
    distances.passes = cpu::nearestOnShape<number>(params, ownPoint, colliders.distances()->data()).distance;
  DISTANCE_SHAPES(IN_PASSES)
#undef IN_PASSES
  if (params.type == COLLIDER_SPHERE) distances.passes = length(ownPoint) - params.radius;
  return distances;
}

// Two formulas for every shape, each written for itself: a mistake in one does not hide in the other.
TEST(Shapes, AreMeasuredAsThePassesSeeThem) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  for (const Collider& collider : defaultColliders()) {
    if (std::holds_alternative<Plane>(collider) || std::holds_alternative<MeshCollider>(collider)) continue;
    for (int i = 0; i < 100; ++i) {
      const auto [passes, measuring] =
          distancesOf(collider, {uniform(engine), uniform(engine), uniform(engine)});
      EXPECT_NEAR(passes, measuring, 1e-12) << typeOf(collider);
    }
  }
}

TEST(Shapes, AreInsideWhereTheyShouldBe) {
  const auto inside = [](const Collider& collider, Vec3d p) { return distancesOf(collider, p).passes < 0; };
  EXPECT_TRUE(inside(Box{.size = {2, 1, 1}}, {0.99, 0, 0}));
  EXPECT_FALSE(inside(Box{.size = {2, 1, 1}}, {0, 0.51, 0}));
  EXPECT_FALSE(inside(Box{.size = {1, 1, 1}, .rounding = 0.2}, {0.49, 0.49, 0.49})) << "rounded off";
  EXPECT_TRUE(inside(Box{.size = {1, 1, 1}, .rounding = 0}, {0.49, 0.49, 0.49}));
  EXPECT_FALSE(inside(Torus{}, {0, 0, 0})) << "the hole";
  EXPECT_TRUE(inside(Torus{}, {0.39, 0, 0}));
  EXPECT_TRUE(inside(Capsule{.length = 1, .radius = 0.1}, {0, 0.59, 0}));
  EXPECT_FALSE(inside(Capsule{.length = 1, .radius = 0.1}, {0.11, 0, 0}));
  EXPECT_TRUE(inside(Cylinder{.height = 1, .radius = 0.1}, {0.07, 0.49, 0.07})) << "sharp rims";
  EXPECT_FALSE(inside(Cylinder{.height = 1, .radius = 0.1}, {0.08, 0, 0.08}));
  EXPECT_FALSE(inside(Cylinder{.height = 1, .radius = 0.1}, {0, 0.51, 0}));
  EXPECT_TRUE(inside(Cone{.height = 1, .radius = 0.4}, {0, 0.49, 0}));
  EXPECT_FALSE(inside(Cone{.height = 1, .radius = 0.4}, {0.1, 0.4, 0}));
  EXPECT_TRUE(inside(Cone{.height = 1, .radius = 0.4, .topRadius = 0.2}, {0, 0, 0.29}));
  EXPECT_FALSE(inside(Cone{.height = 1, .radius = 0.4, .topRadius = 0.2}, {0, 0, 0.31}));
}

// --- Places: axis, rotation, motion

// A particle that rests just inside each shape's surface at `x` comes out along `normal`.
void expectPushedOut(const Collider& collider, Vec3d surface, Vec3d normal) {
  Scene scene = particleScene(collider, 1e-3);
  scene.gravity = {0, 0, 0};
  std::visit([](auto& shape) { shape.friction = 0; }, scene.colliders[0]);
  const test::LoneParticle end = afterSteps(scene, {surface - 1e-3 * normal, {0, 0, 0}});
  EXPECT_NEAR(length(end.x - surface), 0, 1e-9);
  EXPECT_NEAR(length(end.v - (1e-3 / 1e-3) * normal), 0, 1e-6) << "a move dx adds dx / h to the velocity";
}

TEST(Shapes, StandWhereTheirKeysPutThem) {
  const double r = std::sqrt(0.5);
  expectPushedOut(Capsule{.origin = {1, 2, 3}, .axis = {5, 0, 0}, .length = 1, .radius = 0.1}, {1.4, 2, 3.1},
                  {0, 0, 1});
  expectPushedOut(Capsule{.origin = {1, 2, 3}, .axis = {5, 0, 0}, .length = 1, .radius = 0.1}, {1.6, 2, 3},
                  {1, 0, 0});
  expectPushedOut(Torus{.origin = {1, 2, 3}, .axis = {0, 0, -2}, .radius = 0.3, .tubeRadius = 0.1},
                  {1, 2.4, 3}, {0, 1, 0});
  expectPushedOut(Torus{.origin = {1, 2, 3}, .axis = {0, 0, -2}, .radius = 0.3, .tubeRadius = 0.1},
                  {1, 2.3, 3.1}, {0, 0, 1});
  const Cylinder lying{.origin = {1, 2, 3}, .axis = {0, 0, -2}, .height = 1, .radius = 0.2};
  expectPushedOut(lying, {1.05, 2, 3.5}, {0, 0, 1});
  expectPushedOut(lying, {1, 2.2, 3.3}, {0, 1, 0});
  const Cone funnel{.origin = {1, 2, 3}, .axis = {0, 0, -2}, .height = 0.4, .radius = 0.5, .topRadius = 0.1};
  expectPushedOut(funnel, {1.05, 2, 3.2}, {0, 0, 1});
  expectPushedOut(funnel, {1, 2.3, 3}, {0, r, -r});
  expectPushedOut(Box{.origin = {1, 2, 3}, .size = {0.4, 2, 1}, .rotation = {0, 0, 45}},
                  Vec3d{1, 2, 3} + 0.2 * Vec3d{r, r, 0}, {r, r, 0});
}

TEST(Shapes, CarryAParticleThatSticksToThemAlongAndAround) {
  Motion motion;
  motion.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {0.01, {0.02, 0, 0}, {0, 0, 90}}};
  const std::vector<std::pair<Collider, Vec3d>> shapes{
      {Capsule{.axis = {1, 0, 0}, .length = 1, .radius = 0.5, .friction = 1, .motion = motion}, {1, 0, 0}},
      {Box{.size = {2, 1, 1}, .friction = 1, .motion = motion}, {1, 0, 0}},
      {Torus{.axis = {0, 0, 1}, .radius = 0.8, .tubeRadius = 0.2, .friction = 1, .motion = motion},
       {1, 0, 0}},
      {Cylinder{.axis = {1, 0, 0}, .height = 2, .radius = 0.5, .friction = 1, .motion = motion}, {1, 0, 0}},
      {Cone{.axis = {-1, 0, 0}, .height = 2, .radius = 0.5, .friction = 1, .motion = motion}, {1, 0, 0}}};
  for (const auto& [collider, x] : shapes) {
    Scene scene = particleScene(collider, 0.01);
    scene.gravity = {0, 0, 0};
    // Pushed a little inwards, so that it touches.
    const test::LoneParticle end = afterSteps(scene, {x, {1, 0.1, 0}});
    EXPECT_NEAR(end.x.x, 0.02, 1e-6) << collider.index();
    EXPECT_NEAR(end.x.y, 1, 1e-6) << collider.index();
  }
}

// --- Nothing gets through

// Thin and small shapes in the way of a particle that passes them in one step.
std::vector<Collider> obstacles() {
  return {Sphere{.radius = 0.02},
          Capsule{.axis = {0, 0, 1}, .length = 1, .radius = 0.01},
          Box{.size = {1, 0.002, 1}, .rotation = {5, 0, 3}, .rounding = 0.001},
          Box{.size = {1, 0.002, 1}, .rotation = {0, 0, 60}, .rounding = 0},
          Torus{.origin = {-0.3, 0, 0}, .radius = 0.3, .tubeRadius = 0.01},
          Cylinder{.axis = {0.1, 1, 0}, .height = 0.002, .radius = 0.5},
          Cylinder{.axis = {0, 0, 1}, .height = 1, .radius = 0.01},
          Cone{.axis = {0.1, 1, 0}, .height = 0.004, .radius = 0.5, .topRadius = 0.4},
          Cone{.axis = {0, 0, 1}, .height = 1, .radius = 0.02}};
}

struct Law {
  FrictionLaw law;
  double friction;
};
const Law laws[] = {{FrictionLaw::cs184, 0},   {FrictionLaw::cs184, 0.5},   {FrictionLaw::cs184, 1},
                    {FrictionLaw::coulomb, 0}, {FrictionLaw::coulomb, 0.5}, {FrictionLaw::coulomb, 3}};

double signedDistance(const Collider& collider, Vec3d x) {
  const Vec3d p = rotateBack(ownRotation(collider), x - poseAt(collider, 0).position);
  return distancesOf(collider, p).passes;
}

TEST(FastParticle, StaysOnItsSideOfAThinShapeAtAnyFriction) {
  for (const Collider& obstacle : obstacles())
    for (const Law& law : laws)
      for (const double speed : {1.0, 20.0, 100.0})
        for (const double start : {0.05, 0.3, 0.77}) {
          Collider collider = obstacle;
          std::visit([&](auto& shape) { shape.friction = law.friction; }, collider);
          const Scene scene = particleScene(collider, 0.02, law.law);
          const double height = start * speed * 0.02 + 0.03;
          const test::LoneParticle end = afterSteps(scene, {{0.001, height, 0.002}, {0, -speed, 0}});
          const std::string where = "collider " + std::to_string(collider.index()) + ", friction " +
                                    std::to_string(law.friction) + ", speed " + std::to_string(speed) +
                                    ", from " + std::to_string(height);
          EXPECT_GE(signedDistance(collider, end.x), -1e-9) << where;
          EXPECT_GT(end.x.y, -0.002) << where;
        }
}

TEST(FastParticle, StaysOnItsSideOfAMesh) {
  // The neck of a pawn, 0.05 m across, of which a step covers 0.4 m.
  for (const Law& law : laws)
    for (const double start : {0.1, 0.25, 0.35}) {
      const MeshCollider pawn{
          .file = "assets/meshes/pawn.obj", .rotation = {0, 0, 90}, .scale = 0.25, .friction = law.friction};
      const Scene scene = particleScene(pawn, 0.02, law.law);
      const test::LoneParticle end = afterSteps(scene, {{-0.14, start, 0.001}, {0, -20, 0}});
      EXPECT_GT(end.x.y, 0) << law.friction;
      const Cloth cloth(scene);
      State state = initialState(cloth, scene);
      state.positions[0] = {50, 50, 50, 1};
      state.positions[1] = {static_cast<float>(end.x.x), static_cast<float>(end.x.y),
                            static_cast<float>(end.x.z), 1};
      EXPECT_LT(measure(cloth, scene, state).maxPenetration, 2e-4) << law.friction;
    }
}

TEST(FastParticle, FliesThroughTheHoleOfATorus) {
  const Scene scene = particleScene(Torus{.radius = 0.3, .tubeRadius = 0.01}, 0.02);
  EXPECT_LT(afterSteps(scene, {{0.1, 0.2, 0}, {0, -20, 0}}).x.y, -0.19);
}

TEST(FastParticle, IsNotHeldByAShapeThatItOnlyLeaves) {
  for (const Collider& obstacle : obstacles()) {
    const Scene scene = particleScene(obstacle, 0.02);
    const test::LoneParticle end = afterSteps(scene, {{0.001, 0.03, 0}, {1, 30, 0}});
    EXPECT_NEAR(end.x.y, 0.03 + 0.6, 0.01) << obstacle.index();
  }
}

TEST(SlidingParticle, GetsOverTheSharpEdgeOfABoxWithoutFriction) {
  for (const double rounding : {0.0, 0.01})
    for (const FrictionLaw law : {FrictionLaw::cs184, FrictionLaw::coulomb}) {
      const Box box{.size = {1, 1, 1}, .rounding = rounding, .friction = 0};
      Scene scene = particleScene(box, 1.0 / 2700, law);
      scene.gravity = {0, -9.8, 0};
      // Half a second at 1 m/s from 0.1 m before the edge: it leaves the edge and falls 0.78 m at most.
      const test::LoneParticle end = afterSteps(scene, {{0.4, 0.5, 0}, {1, 0, 0}}, 1350);
      EXPECT_NEAR(end.x.x, 0.9, 0.02) << rounding;
      EXPECT_NEAR(end.x.y, 0.5 - 0.5 * 9.8 * 0.4 * 0.4, 0.05) << rounding;
    }
}

// A cloth of 50 x 50 points, hanging from its upper edge, and the sphere of the issue: 0.05 m, 20 m/s, 0.3 m.
// Without a strain limit and without friction the points slide off to all sides, and the sphere leaves
// through the hole between them, which no contact of points can close; there it must only be kept out of the
// points.
TEST(FastSphere, PushesAHangingClothAndNoPointIsLeftInside) {
  for (const int stepsOfFrame : {1, 4, 30}) {
    for (const Law& law : laws) {
      Scene scene = sheetScene(50);
      scene.cloths[0].orientation = Orientation::vertical;
      scene.cloths[0].pinned = {GridSide::top};
      scene.cloths[0].ks = stepsOfFrame == 30 ? 5000 : 5;
      scene.solver.simulationSteps = stepsOfFrame;
      scene.solver.frictionLaw = law.law;
      scene.solver.strainLimit = 0.1;  // without it and without friction points part around the sphere
      Motion motion;
      motion.keys = {{0, {0.5, 0.5, -0.1}, {}}, {0.015, {0.5, 0.5, 0.2}, {}}};
      scene.colliders = {Sphere{.origin = {}, .radius = 0.05, .friction = law.friction, .motion = motion}};
      const Cloth cloth(scene);
      CpuSolver<float> solver(cloth, scene);
      double deepest = 0, farthest = 0;
      for (int i = 0; i < std::ceil(0.015 * 90 * stepsOfFrame); ++i) {
        solver.step(1);
        deepest = std::max(deepest, measure(cloth, scene, solver.state()).maxPenetration);
      }
      for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
        farthest = std::max(farthest, static_cast<double>(solver.position(i).z));
      const std::string where =
          std::to_string(stepsOfFrame) + " steps a frame, friction " + std::to_string(law.friction);
      EXPECT_LE(deepest, 1e-4 * 0.05) << where;
      EXPECT_GT(farthest, 0.23) << "the sphere's front is at 0.25 m; " << where;
    }
  }
}

TEST(FastCloth, StaysAboveThePlaneThatItFallsOn) {
  for (const Law& law : laws)
    for (const int stepsOfFrame : {1, 30}) {
      Scene scene = sheetScene(11);
      scene.cloths[0].ks = stepsOfFrame == 1 ? 5 : 5000;
      scene.solver.simulationSteps = stepsOfFrame;
      scene.solver.frictionLaw = law.law;
      scene.colliders = {Plane{.point = {0, 0.93, 0}, .normal = {0, 2, 0}, .friction = law.friction}};
      const Cloth cloth(scene);
      CpuSolver<float> solver(cloth, scene);
      for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) solver.setVelocity(i, {0, -10, 0});
      for (int frame = 0; frame < 20; ++frame) {
        solver.step(stepsOfFrame);
        EXPECT_LE(measure(cloth, scene, solver.state()).maxPenetration, 2e-7)
            << "friction " << law.friction << ", frame " << frame;
      }
    }
}

// --- Friction

TEST(CoulombFriction, TakesTheCoefficientTimesTheDepthFromTheSlide) {
  const Plane plane{.point = {0, 2, 0}, .normal = {0, 1, 0}, .friction = 0.25};
  Scene scene = particleScene(plane, 0.01, FrictionLaw::coulomb);
  scene.gravity = {0, 0, 0};
  // From the surface 0.03 along x and 0.04 down: 0.25 * 0.04 = 0.01 of the slide are lost.
  const test::LoneParticle sliding = afterSteps(scene, {{0, 2, 0}, {3, -4, 0}});
  // The slack spring that the scene comes with pulls a little, too.
  EXPECT_NEAR(sliding.x.x, 0.02, 1e-10);
  EXPECT_NEAR(sliding.x.y, 2, 1e-12) << "on the plane, not above it";
  EXPECT_NEAR(sliding.v.x, 2, 1e-8);
  EXPECT_NEAR(sliding.v.y, 0, 1e-8) << "nothing is left of the normal velocity";
  const test::LoneParticle sticking = afterSteps(scene, {{0, 2, 0}, {0.9, -4, 0}});
  EXPECT_NEAR(sticking.x.x, 0, 1e-12);
  EXPECT_NEAR(sticking.v.x, 0, 1e-9);
}

TEST(CoulombFriction, FeelsTheVelocityOfAMovingCollider) {
  Motion motion;
  motion.keys = {{0, {0, 0, 0}, {}}, {1, {2, 0, 0}, {}}};  // a belt at 2 m/s
  for (const Collider& belt : {Collider{Plane{.normal = {0, 1, 0}, .friction = 0.3, .motion = motion}},
                               Collider{Box{.size = {40, 1, 1}, .friction = 0.3, .motion = motion}}}) {
    const double top = std::holds_alternative<Box>(belt) ? 0.5 : 0;
    Scene scene = particleScene(belt, 1e-3, FrictionLaw::coulomb);
    scene.gravity = {0, -9.8, 0};
    const test::LoneParticle early = afterSteps(scene, {{0, top, 0}, {0, 0, 0}}, 200);
    EXPECT_NEAR(early.v.x, 0.3 * 9.8 * 0.2, 1e-3) << "speeds up by mu g";
    const test::LoneParticle late = afterSteps(scene, {{0, top, 0}, {0, 0, 0}}, 950);
    EXPECT_NEAR(late.v.x, 2, 1e-3) << "and then rides along";
  }
}

TEST(CoulombFriction, PlaneIsSolidBehindItsNormal) {
  const Plane plane{.point = {0, 0, 0}, .normal = {0, 1, 0}, .friction = 0};
  const Scene scene = particleScene(plane, 0.01, FrictionLaw::coulomb);
  EXPECT_NEAR(afterSteps(scene, {{0, -0.3, 0}, {0, 0, 0}}).x.y, 0, 1e-12);
}

TEST(Penetration, IsMeasuredForEveryShape) {
  const std::vector<std::pair<Collider, double>> depths{
      {Sphere{.origin = {0, -0.5, 0}, .radius = 0.6}, 0.1},
      {Plane{.point = {0, 0.2, 0}, .normal = {0, 3, 0}}, 0.2},
      {Capsule{.origin = {0.3, -0.1, 0}, .axis = {2, 0, 0}, .length = 1, .radius = 0.15}, 0.05},
      {Box{.origin = {0, -0.4, 0}, .size = {1, 1, 3}, .rotation = {0, 30, 0}, .rounding = 0.2}, 0.1},
      {Torus{.origin = {0.5, 0, 0.05}, .axis = {0, 0, 1}, .radius = 0.5, .tubeRadius = 0.2}, 0.15},
      {Cylinder{.origin = {0, 0.4, 0}, .axis = {0, 2, 0}, .height = 1, .radius = 0.3}, 0.1},
      {Cylinder{.origin = {0, 0.25, 0}, .axis = {3, 0, 0}, .height = 1, .radius = 0.3}, 0.05},
      {Cone{.origin = {0, 0.45, 0}, .height = 1, .radius = 0.3, .topRadius = 0.2}, 0.05},
      {Cone{.origin = {0, 0.3, 0}, .axis = {0, 1, 0}, .height = 1, .radius = 1, .topRadius = 0}, 0.2}};
  for (const auto& [collider, depth] : depths) {
    Scene scene = particleScene(collider, 0.01, FrictionLaw::coulomb);
    const Cloth cloth(scene);
    State state = initialState(cloth, scene);
    state.positions[0] = {0, 0, 0, 1};
    state.positions[1] = {50, 50, 50, 1};
    EXPECT_NEAR(measure(cloth, scene, state).maxPenetration, depth, 1e-9) << collider.index();
  }
}

}  // namespace
}  // namespace clothsim
