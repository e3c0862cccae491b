// Motion of the cloth as a whole, which needs no new search for contacts.
#include "solver/cpu/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"

namespace clothsim::cpu {
namespace {

Components<double> cloud(const std::vector<Vec3d>& points) {
  Components<double> result;
  result.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) put(result, static_cast<std::ptrdiff_t>(i), points[i]);
  return result;
}

const std::vector<Vec3d> corners{{0, 0, 0}, {2, 0, 0.5}, {0.3, 1, 0}, {-1, 0.4, 3}, {1, 1, 1}};

Vec3d mapped(const RigidMap<double>& map, Vec3d x) {
  const Vec3d arm = x - map.center;
  return map.movedCenter + Vec3d{dot(map.rows[0], arm), dot(map.rows[1], arm), dot(map.rows[2], arm)};
}

TEST(RigidMotion, OfABodyThatFliesAndTurnsIsItsOwn) {
  const Vec3d spin{0, 0, 2}, flight{1, -3, 0.5}, pivot{0.4, 0.2, 0.1};
  std::vector<Vec3d> velocities;
  for (const Vec3d& x : corners) velocities.push_back(flight + cross(spin, x - pivot));
  const RigidMap<double> quarter = RigidMotion(cloud(corners), cloud(velocities)).after<double>(M_PI / 4);
  Vec3d center;
  for (const Vec3d& x : corners) center = center + 0.2 * x;
  const Vec3d moved = center + (M_PI / 4) * (flight + cross(spin, center - pivot));
  for (const Vec3d& x : corners) {  // a quarter turn about z, x to y
    const Vec3d arm = x - center, there = moved + Vec3d{-arm.y, arm.x, arm.z}, found = mapped(quarter, x);
    EXPECT_NEAR(found.x, there.x, 1e-12);
    EXPECT_NEAR(found.y, there.y, 1e-12);
    EXPECT_NEAR(found.z, there.z, 1e-12);
  }
}

TEST(RigidMotion, KeepsDistancesWhateverTheVelocities) {
  std::vector<Vec3d> velocities{{5, 1, 0}, {-2, 0, 4}, {0, 0, 0}, {1, 8, -3}, {3, 3, 3}};
  const RigidMap<double> map = RigidMotion(cloud(corners), cloud(velocities)).after<double>(0.7);
  for (const Vec3d& a : corners)
    for (const Vec3d& b : corners) {
      const Vec3d before = a - b, after = mapped(map, a) - mapped(map, b);
      EXPECT_NEAR(dot(after, after), dot(before, before), 1e-11);
    }
}

TEST(RigidMotion, OfPointsInLineTurnsNothingAboutTheLine) {
  const std::vector<Vec3d> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const RigidMap<double> map =
      RigidMotion(cloud(line), cloud({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}})).after<double>(1);
  EXPECT_NEAR(mapped(map, {2, 0, 0}).y, 1, 1e-12);
  EXPECT_NEAR(mapped(map, {2, 0, 0}).x, 2, 1e-12);
}

// It falls ten cells, and moves by its search's reach again and again.
TEST(RigidMotion, OfAFallingSheetAsksForNoNewSearch) {
  Scene scene = test::sheetScene(17);
  scene.cloths[0].pinned.clear();
  scene.colliders.clear();
  scene.solver.selfCollision = clothsim::SelfCollision::robust;
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const double start = solver.position(0).y;
  for (int i = 0; i < 20'000 && start - solver.position(0).y < 10 * (1.0 / 16); ++i) solver.step(1);
  EXPECT_GT(start - solver.position(0).y, 0.5) << "it does not fall";
  EXPECT_LT(solver.contactCounts().hashBuilds, 12u);
}

}  // namespace
}  // namespace clothsim::cpu
