#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clothsim {
namespace {

constexpr double poseTolerance = 1e-14;

void expectNear(Vec3d a, Vec3d b) {
  EXPECT_NEAR(a.x, b.x, poseTolerance);
  EXPECT_NEAR(a.y, b.y, poseTolerance);
  EXPECT_NEAR(a.z, b.z, poseTolerance);
}

Sphere moving(bool loop) {
  Sphere sphere;
  sphere.origin = {9, 9, 9};
  sphere.motion =
      Motion{{{1, {0, 0, 0}, {0, 0, 0}}, {2, {4, 0, 2}, {0, 90, 0}}, {4, {4, 8, 2}, {0, 90, 0}}}, loop};
  return sphere;
}

TEST(RotationMatrix, IsExactlyTheIdentityForNoRotation) {
  EXPECT_EQ(rotationMatrix({0, 0, 0}), (Matrix3{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}));
}

// Right-handed: 90 degrees about x takes y to z, and so on round.
TEST(RotationMatrix, TurnsByTheRightHandRule) {
  expectNear(rotate(rotationMatrix({90, 0, 0}), {0, 1, 0}), {0, 0, 1});
  expectNear(rotate(rotationMatrix({0, 90, 0}), {0, 0, 1}), {1, 0, 0});
  expectNear(rotate(rotationMatrix({0, 0, 90}), {1, 0, 0}), {0, 1, 0});
}

// A third of a turn about the diagonal permutes the axes.
TEST(RotationMatrix, TurnsAboutAnyAxis) {
  const double third = 120 / std::sqrt(3.0);
  expectNear(rotate(rotationMatrix({third, third, third}), {1, 2, 3}), {3, 1, 2});
}

TEST(RotationMatrix, KeepsLengthsAndIsUndoneByRotateBack) {
  const Matrix3 rotation = rotationMatrix({123, -456, 78});
  const Vec3d v{0.3, -1.7, 2.2};
  EXPECT_NEAR(dot(rotate(rotation, v), rotate(rotation, v)), dot(v, v), 1e-13);
  expectNear(rotateBack(rotation, rotate(rotation, v)), v);
}

TEST(PoseAt, IsTheCollidersOwnPlaceWithoutMotion) {
  const Pose sphere = poseAt(Sphere{{1, 2, 3}, 0.2, 0.5, std::nullopt}, 7);
  EXPECT_EQ(sphere.position, (Vec3d{1, 2, 3}));
  EXPECT_EQ(sphere.rotation, Pose{}.rotation);
  EXPECT_EQ(poseAt(Plane{{4, 5, 6}, {0, 1, 0}, 0.5, std::nullopt}, 7).position, (Vec3d{4, 5, 6}));
}

TEST(PoseAt, IsLinearBetweenKeys) {
  const Pose pose = poseAt(moving(false), 1.5);
  expectNear(pose.position, {2, 0, 1});
  expectNear(rotate(pose.rotation, {0, 0, 1}), {std::sqrt(0.5), 0, std::sqrt(0.5)});  // 45 degrees about y
  expectNear(poseAt(moving(false), 3).position, {4, 4, 2});
}

TEST(PoseAt, HitsKeysExactly) {
  EXPECT_EQ(poseAt(moving(false), 1).position, (Vec3d{0, 0, 0}));
  EXPECT_EQ(poseAt(moving(false), 2).position, (Vec3d{4, 0, 2}));
  EXPECT_EQ(poseAt(moving(false), 4).position, (Vec3d{4, 8, 2}));
}

TEST(PoseAt, StandsStillBeforeTheFirstAndAfterTheLastKey) {
  EXPECT_EQ(poseAt(moving(false), -1).position, (Vec3d{0, 0, 0}));
  EXPECT_EQ(poseAt(moving(false), 0.5).position, (Vec3d{0, 0, 0}));
  EXPECT_EQ(poseAt(moving(false), 100).position, (Vec3d{4, 8, 2}));
}

TEST(PoseAt, BeginsAgainAfterTheLastKeyOfALoop) {
  for (const double t : {0.25, 1.5, 2.75, 3.5}) {
    expectNear(poseAt(moving(true), t + 4).position, poseAt(moving(true), t).position);
    expectNear(poseAt(moving(true), t + 40).position, poseAt(moving(true), t).position);
    expectNear(poseAt(moving(true), t).position, poseAt(moving(false), t).position);
  }
  EXPECT_EQ(poseAt(moving(true), 4).position, (Vec3d{0, 0, 0}));
}

TEST(PoseAt, TurnsMoreThanOnceBetweenTwoKeys) {
  Plane plane;
  plane.motion = Motion{{{0, {}, {0, 0, 0}}, {1, {}, {0, 0, 720}}}, false};
  expectNear(rotate(poseAt(plane, 0.125).rotation, {1, 0, 0}), {0, 1, 0});  // 90 degrees
  expectNear(rotate(poseAt(plane, 0.75).rotation, {1, 0, 0}), {-1, 0, 0});  // 540 degrees
}

}  // namespace
}  // namespace clothsim
