#include "scene/moved_collider.h"

#include <gtest/gtest.h>

#include "scene/pose.h"

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

TEST(MovedCollider, DoesNotSpinBackWhereALoopBeginsAnew) {
  Sphere sphere;
  sphere.motion = pathTo({4, 0, 0});
  sphere.motion->loop = true;
  const Scene onItsWay = withColliderOnItsWay(sceneWith(sphere), 1, {0, 1, 0}, 1.9, 2.1);
  const Motion& way = *std::get<Sphere>(onItsWay.colliders[1]).motion;
  EXPECT_EQ(way.keys[0].rotation, way.keys[1].rotation);
  EXPECT_FALSE(way.loop);
}

}  // namespace
}  // namespace clothsim
