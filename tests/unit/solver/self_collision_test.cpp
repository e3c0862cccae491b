#include "solver/self_collision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "core/thread_team.h"
#include "measure/measure_contacts.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/self_collision.h"
#include "support/compared_scenes.h"
#include "support/point_clouds.h"

namespace clothsim {
namespace {

using test::cloud;
using test::contactScene;
using test::point;

// --- One pass over given positions

struct Pushed {
  std::vector<Vec3d> moves;
  Components<float> velocities;
};

// Contacts of a step from `before` to `after`, resolved.
void resolveContacts(cpu::SelfCollision<float>& collision, const CpuState<float>& before,
                     CpuState<float>& after, const std::vector<float>& inverseMasses) {
  for (const PassCall call : {PassCall{Pass::checkHash}, PassCall{Pass::buildHash, HASHES_END},
                              PassCall{Pass::findCandidates}, PassCall{Pass::resolveContacts}})
    collision.run(call, before, after, inverseMasses);
}

Pushed separated(const Scene& scene, const Cloth& cloth, const Components<float>& points,
                 const std::vector<float>& inverseMasses) {
  cpu::SelfCollision<float> collision(cloth);
  collision.configure(scene);
  CpuState<float> before, after;
  before.positions = after.positions = points;
  before.velocities = after.velocities = cloud(points.x.size());
  resolveContacts(collision, before, after, inverseMasses);
  Pushed result{{}, after.velocities};
  for (std::size_t i = 0; i < points.x.size(); ++i)
    result.moves.push_back(point(after.positions, i) - point(points, i));
  return result;
}

// The lattice, spread out so that only what a test moves is near anything.
Components<float> spreadOut(const Cloth& cloth) {
  Components<float> points = cloud(cloth.particleCount());
  for (std::size_t i = 0; i < points.x.size(); ++i) points.x[i] = 3 * static_cast<float>(i);
  return points;
}

TEST(Separate, GivesEachOfTwoWhatCs184Gives) {
  const Scene scene = contactScene(10, SelfCollision::averaged);
  const Cloth cloth(scene);
  Components<float> points = spreadOut(cloth);
  const double distance = contactDistance(scene, cloth);
  points.x[57] = points.x[4];
  points.y[57] = static_cast<float>(0.25 * distance);
  const Pushed pushed = separated(scene, cloth, points, std::vector<float>(100, 1.0f));
  const double expected = 0.75 * distance / scene.solver.simulationSteps;
  EXPECT_NEAR(pushed.moves[57].y, expected, 1e-5 * expected);
  EXPECT_NEAR(pushed.moves[4].y, -expected, 1e-5 * expected);
  EXPECT_NEAR(pushed.velocities.y[57], expected / stepLength(scene.solver),
              1e-4 * expected / stepLength(scene.solver));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(pushed.moves[i] != Vec3d{}, i == 4 || i == 57) << i;
}

TEST(Separate, TakesTheMeanOverSeveralContacts) {
  const Scene scene = contactScene(10, SelfCollision::averaged);
  const Cloth cloth(scene);
  Components<float> points = spreadOut(cloth);
  const double distance = contactDistance(scene, cloth);
  points.x[57] = points.x[81] = points.x[4];
  points.y[57] = static_cast<float>(0.5 * distance);
  points.z[81] = static_cast<float>(0.25 * distance);
  const Vec3d move = separated(scene, cloth, points, std::vector<float>(100, 1.0f)).moves[4];
  const double steps = scene.solver.simulationSteps;
  EXPECT_NEAR(move.y, -0.5 * distance / 2 / steps, 1e-5 * distance / steps);
  EXPECT_NEAR(move.z, -0.75 * distance / 2 / steps, 1e-5 * distance / steps);
}

TEST(Separate, NeverMovesAPinAndPushesItsNeighbourTheWholeWay) {
  const Scene scene = contactScene(10, SelfCollision::robust);
  const Cloth cloth(scene);
  Components<float> points = spreadOut(cloth);
  std::vector<float> inverseMasses(100, 1.0f);
  inverseMasses[4] = 0;
  points.x[57] = points.x[4];
  const double distance = contactDistance(scene, cloth);
  points.y[57] = static_cast<float>(0.99 * distance);
  const std::vector<Vec3d> pinned = separated(scene, cloth, points, inverseMasses).moves;
  EXPECT_EQ(pinned[4], Vec3d{});
  EXPECT_GT(pinned[57].y, 0.0099 * distance);
}

TEST(Separate, PartsTwoParticlesAtOnePlace) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    const Scene scene = contactScene(10, mode);
    const Cloth cloth(scene);
    Components<float> points = spreadOut(cloth);
    points.x[57] = points.x[4];
    const std::vector<Vec3d> moves = separated(scene, cloth, points, std::vector<float>(100, 1.0f)).moves;
    EXPECT_LT(moves[4].y, 0);
    EXPECT_EQ(moves[57].y, -moves[4].y);
  }
}

// Contact sums are whole numbers, so two free particles give each other exactly the same, whatever the others
// do.
TEST(Separate, KeepsMomentumToTheBitForPairs) {
  const Scene scene = contactScene(10, SelfCollision::robust);
  const Cloth cloth(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> offset(-0.05f, 0.05f);
  for (int i = 0; i < 100; ++i) {
    Components<float> points = spreadOut(cloth);
    points.x[4] = 0.25f;  // far from the others, and small, so that adding a move does not round
    points.x[57] = 0.25f + offset(random);
    points.y[57] = offset(random);
    const std::vector<Vec3d> moves = separated(scene, cloth, points, std::vector<float>(100, 1.0f)).moves;
    EXPECT_NEAR(moves[4].x, -moves[57].x, 3e-8);
    EXPECT_NEAR(moves[4].y, -moves[57].y, 3e-8);
  }
}

TEST(Separate, TakesBackSlipUpToFriction) {
  Scene scene = contactScene(10, SelfCollision::robust);
  const Cloth cloth(scene);
  const double distance = contactDistance(scene, cloth);
  const auto slide = [&](double friction, double depth, double slip) {
    scene.solver.selfFriction = friction;
    cpu::SelfCollision<float> collision(cloth);
    collision.configure(scene);
    CpuState<float> before, after;
    before.positions = spreadOut(cloth);
    before.positions.x[57] = before.positions.x[4] = 0.5f;
    before.positions.x[0] = -9;
    before.positions.y[57] = static_cast<float>(distance - depth);
    after.positions = before.positions;
    after.positions.x[57] += static_cast<float>(slip);
    before.velocities = after.velocities = cloud(100);
    resolveContacts(collision, before, after, std::vector<float>(100, 1.0f));
    return static_cast<double>(after.positions.x[57] - after.positions.x[4]);
  };
  const double depth = 0.01 * distance, slip = 0.02 * distance;
  EXPECT_GT(slide(0, depth, slip), 0.999 * slip);
  // The slip tilts the line between the two by 0.02, which lets through that much of it.
  EXPECT_LT(std::abs(slide(10, depth, slip)), 0.03 * slip) << "sticks";
  const double some = slide(0.5, depth, slip);
  EXPECT_NEAR(some, slip - 0.5 * depth, 0.03 * slip);
}

// --- Whole steps

TEST(SelfCollisionStep, LeavesAFlatSheetStillEvenWhenItIsThickerThanItsSpacing) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    Scene scene = contactScene(16, mode);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].thickness = 3.0 / 15;
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    solver.step(30);
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      const Vec3d moved = solver.position(i) - cloth.positions()[i];
      EXPECT_LT(std::sqrt(dot(moved, moved)), 1e-9) << i;
    }
  }
}

std::uint64_t hashAfter(const Scene& scene, int steps, bool forgetHash) {
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  for (int i = 0; i < steps; ++i) {
    if (forgetHash) solver.setState(solver.state());
    solver.step(1);
  }
  EXPECT_GT(measureContacts(cloth, scene, solver.state(), 0).contacts, 100u) << "the test is about contacts";
  EXPECT_TRUE(forgetHash || solver.contactCounts().hashBuilds < static_cast<std::uint64_t>(steps) / 2)
      << "and about reuse";
  return stateHash(solver.state());
}

TEST(SelfCollisionStep, ComesToTheSameBitsWithAHashOfAnEarlierStep) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    const Scene scene = test::layeredSheets(24, mode);
    EXPECT_EQ(hashAfter(scene, 400, false), hashAfter(scene, 400, true)) << selfCollisionName(mode);
  }
}

TEST(SelfCollisionStep, ComesToTheSameBitsWithAnyNumberOfThreads) {
  const int threads = ThreadTeam::shared().threads();
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    const Scene scene = test::layeredSheets(66, mode);
    std::set<std::uint64_t> hashes;
    for (const int count : {1, 2, 5}) {
      ThreadTeam::setSharedThreads(count);
      hashes.insert(hashAfter(scene, 150, false));
    }
    ThreadTeam::setSharedThreads(threads);
    EXPECT_EQ(hashes.size(), 1u) << selfCollisionName(mode);
  }
}

TEST(SelfCollisionStep, RobustKeepsLayersApartThatAreThrownAtEachOther) {
  for (const double speed : {2.0, 8.0}) {
    Scene scene = test::layeredSheets(24, SelfCollision::robust);
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    for (std::uint32_t i = 576; i < 1152; ++i) solver.setVelocity(i, {0, static_cast<float>(-speed), 0});
    ContactMeasures worst;
    for (int frame = 0; frame < 30; ++frame) {
      solver.step(scene.solver.simulationSteps);
      const ContactMeasures now = measureContacts(cloth, scene, solver.state(), 0.1);
      worst.contacts = std::max(worst.contacts, now.contacts);
      worst.overlaps = std::max(worst.overlaps, now.overlaps);
    }
    EXPECT_GT(worst.contacts, 100u);
    EXPECT_EQ(worst.overlaps, 0u) << "at " << speed << " m/s";
    EXPECT_EQ(solver.contactCounts().fastSteps, 0u);
  }
}

TEST(SelfCollisionStep, LetsTwoLayersFallTogetherAsFastAsOne) {
  Scene scene = test::layeredSheets(16, SelfCollision::robust);
  scene.cloths[0].pinned.clear();
  scene.cloths[0].damping = scene.cloths[1].damping = 0;
  scene.cloths[1].rotation = {0, 0, 0};
  const Cloth cloth(scene);
  scene.cloths[1].position = {0, 1.02 * contactDistance(scene, cloth), 0};
  const Cloth close(scene);
  CpuSolver<double> solver(close, scene);
  const int steps = 2 * 2700;  // 2 s, at the end 19.6 m/s
  solver.step(steps);
  const double t = steps * stepLength(scene.solver);
  EXPECT_NEAR(solver.position(0).y, close.positions()[0].y - 4.9 * t * t, 0.02);
  EXPECT_NEAR(solver.position(300).y, close.positions()[300].y - 4.9 * t * t, 0.02);
}

TEST(ContactDistance, IsTwiceTheThicknessForCs184AndSoundForRobust) {
  Scene scene = contactScene(11, SelfCollision::averaged);
  const Cloth cloth(scene);
  EXPECT_NEAR(contactDistance(scene, cloth), 2 * 0.049, 1e-12);
  scene.solver.selfCollision = SelfCollision::robust;
  EXPECT_NEAR(contactDistance(scene, cloth), (1 + 0.1 + 0.15) * 0.1, 1e-12);
  scene.cloths[0].thickness = 0.2;
  EXPECT_NEAR(contactDistance(scene, cloth), 0.2, 1e-12);
  scene.cloths[0].thickness = 5;
  EXPECT_NEAR(contactDistance(scene, cloth), 0.7, 1e-12) << "seven spacings at most";
  scene.solver.selfCollision = SelfCollision::averaged;
  scene.cloths[0].thickness = 0;
  EXPECT_FALSE(collidesWithItself(scene, cloth));
}

TEST(ContactDistance, IsThatOfTheSheetAlsoBesideARope) {
  Scene scene = contactScene(11, SelfCollision::averaged);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numHeightPoints = 1;
  const Cloth cloth(scene);
  EXPECT_NEAR(contactDistance(scene, cloth), 2 * 0.049, 1e-12) << "a rope has no spacing across";
}

}  // namespace
}  // namespace clothsim
