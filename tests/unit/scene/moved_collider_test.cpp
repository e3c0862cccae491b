#include "scene/moved_collider.h"

#include <gtest/gtest.h>

#include "scene/pose.h"
#include "scene/rotation_vector.h"

namespace clothsim {
namespace {

Scene sceneWith(const Collider& collider) {
  Scene scene;
  scene.colliders = {Plane{}, collider};
  return scene;
}
Motion pathTo(Vec3d end) {
  Motion motion;
  motion.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {2, end, {0, 90, 0}}};
  return motion;
}

TEST(MovedCollider, GoesStraightAndStaysThere) {
  const Scene scene = sceneWith(Box{.origin = {1, 0, 0}, .rotation = {0, 30, 0}});
  const Scene onItsWay = withColliderOnItsWay(scene, 1, {3, 4, 0}, 10, 12);
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 10).position, (Vec3d{1, 0, 0}));
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 11).position, (Vec3d{2, 2, 0}));
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 12).position, (Vec3d{3, 4, 0}));
  EXPECT_EQ(onItsWay.colliders[0], scene.colliders[0]);

  Box there = std::get<Box>(scene.colliders[1]);
  there.origin = {3, 4, 0};
  EXPECT_EQ(withColliderAt(scene, 1, {3, 4, 0}, 12).colliders[1], Collider(there));
}

TEST(MovedCollider, MovesAPlaneByItsPoint) {
  const Scene scene =
      sceneWith(Plane{.point = {0, 1, 0}, .normal = {0, 0, 1}, .friction = 0.5, .motion = std::nullopt});
  EXPECT_EQ(std::get<Plane>(withColliderAt(scene, 1, {0, 2, 0}, 0).colliders[1]).point, (Vec3d{0, 2, 0}));
}

// Its path goes on, shifted; meanwhile it turns as the path says.
TEST(MovedCollider, ShiftsAPathOfItsOwn) {
  Sphere sphere;
  sphere.motion = pathTo({4, 0, 0});
  const Scene scene = sceneWith(sphere);
  const Scene onItsWay = withColliderOnItsWay(scene, 1, {2, 5, 0}, 0.5, 1);
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 0.5).position, (Vec3d{1, 0, 0}));
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 1).position, (Vec3d{2, 5, 0}));
  EXPECT_EQ(std::get<Sphere>(onItsWay.colliders[1]).motion->keys[0].rotation, (Vec3d{0, 22.5, 0}));
  EXPECT_EQ(std::get<Sphere>(onItsWay.colliders[1]).motion->keys[1].rotation, (Vec3d{0, 45, 0}));
  const Scene after = withColliderAt(scene, 1, {2, 5, 0}, 1);
  EXPECT_EQ(poseAt(after.colliders[1], 1).position, (Vec3d{2, 5, 0}));
  EXPECT_EQ(poseAt(after.colliders[1], 2).position, (Vec3d{4, 5, 0}));
}

TEST(MovedCollider, RestsWhereItsPathHasTakenIt) {
  const Motion path{{{0, {1, 0, 0}, {}}, {2, {3, 0, 0}, {0, 0, 60}}}};
  const Scene moving = sceneWith(Box{.origin = {1, 0, 0}, .rotation = {0, 0, 20}, .motion = path});
  const Scene rest = withColliderAtRest(moving, 1, 1);
  EXPECT_FALSE(moves(rest.colliders[1]));
  EXPECT_EQ(std::get<Box>(rest.colliders[1]).origin, (Vec3d{2, 0, 0}));
  EXPECT_LT(length(std::get<Box>(rest.colliders[1]).rotation - Vec3d{0, 0, 50}), 1e-9);
  EXPECT_EQ(withColliderAtRest(rest, 1, 5), rest);
}

TEST(MovedCollider, DoesNotSpinBackWhereALoopBeginsAnew) {
  Sphere sphere;
  sphere.motion = pathTo({4, 0, 0});
  sphere.motion->loop = true;
  const Scene onItsWay = withColliderOnItsWay(sceneWith(sphere), 1, {0, 1, 0}, 1.9, 2.1);
  const Motion& way = *std::get<Sphere>(onItsWay.colliders[1]).motion;
  EXPECT_EQ(way.keys[0].rotation, way.keys[1].rotation);
  EXPECT_FALSE(way.loop);
}

void expectNear(const Matrix3& a, const Matrix3& b) {
  for (std::size_t row = 0; row < 3; ++row) EXPECT_LT(length(a[row] - b[row]), 1e-12) << row;
}
Matrix3 standing(const Collider& collider, double time) {
  return product(poseAt(collider, time).rotation, ownRotation(collider));
}

TEST(RotationVector, IsTheInverseOfTheRotationMatrix) {
  for (const Vec3d degrees : {Vec3d{0, 0, 0}, Vec3d{1e-6, 0, 2e-6}, Vec3d{10, -20, 30}, Vec3d{0, 179.999, 0},
                              Vec3d{-100, 90, 60}, Vec3d{1, 2, -150}}) {
    EXPECT_LT(length(rotationVector(rotationMatrix(degrees)) - degrees), 1e-9 + 1e-12 * length(degrees));
    expectNear(rotationMatrix(rotationVector(rotationMatrix(3.0 * degrees))), rotationMatrix(3.0 * degrees));
  }
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d half;
    (axis == 0 ? half.x : axis == 1 ? half.y : half.z) = 180;
    expectNear(rotationMatrix(rotationVector(rotationMatrix(half))), rotationMatrix(half));
  }
}

TEST(TurnedCollider, TurnsOnItsWayAndStaysTurned) {
  const Matrix3 turn = rotationMatrix({0, 0, 40});
  for (const Collider& collider :
       {Collider(Box{.rotation = {30, 0, 0}}), Collider(Capsule{.axis = {1, 1, 0}}),
        Collider(Plane{.normal = {0, 1, 1}})}) {
    const Scene scene = sceneWith(collider);
    const ColliderMove move{1, std::nullopt, turn};
    const Scene onItsWay = withColliderOnItsWay(scene, move, 2, 3);
    const Matrix3 before = standing(collider, 2);
    expectNear(standing(onItsWay.colliders[1], 2), before);
    expectNear(standing(onItsWay.colliders[1], 2.5), product(rotationMatrix({0, 0, 20}), before));
    expectNear(standing(onItsWay.colliders[1], 3), product(turn, before));
    // Of a round shape the axis alone is known.
    const Matrix3 after = standing(withColliderMoved(scene, move, 3).colliders[1], 3);
    EXPECT_LT(length(rotate(after, {0, 1, 0}) - rotate(product(turn, before), {0, 1, 0})), 1e-12);
  }
}

// A box that flies and spins goes on as before, turned by as much as it was turned by hand.
TEST(TurnedCollider, GoesOnAlongItsPath) {
  Box box{.rotation = {0, 0, 10}};
  box.motion = pathTo({4, 0, 0});
  const Scene scene = sceneWith(box);
  const ColliderMove move{1, std::nullopt, rotationMatrix({25, 0, 0})};
  const Scene onItsWay = withColliderOnItsWay(scene, move, 0.5, 1), after = withColliderMoved(scene, move, 1);
  expectNear(standing(onItsWay.colliders[1], 0.5), standing(scene.colliders[1], 0.5));
  const Matrix3 wanted = product(*move.turn, standing(scene.colliders[1], 1));
  expectNear(standing(onItsWay.colliders[1], 1), wanted);
  expectNear(standing(after.colliders[1], 1), wanted);
  for (const double time : {1.0, 1.5, 2.0})
    EXPECT_EQ(poseAt(after.colliders[1], time).position, poseAt(scene.colliders[1], time).position);
  EXPECT_EQ(poseAt(onItsWay.colliders[1], 1).position, poseAt(scene.colliders[1], 1).position);
}

}  // namespace
}  // namespace clothsim
