// Seams: which points they join, and what their springs do in explicit and in implicit steps.
#include "cloth/seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "cloth/seam_neighbours.h"
#include "measure/run_watch.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/cpu_solver.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

// A strip of columns x rows points that stands; the second lies `gap` below the first one.
Scene twoStrips(int columns, int otherColumns, double gap) {
  Scene scene;
  ClothSettings upper;
  upper.ks = 2000;
  upper.orientation = Orientation::vertical;
  upper.width = upper.height = 0.2;
  upper.numWidthPoints = columns;
  upper.numHeightPoints = 3;
  upper.density = 1;
  upper.position = {0, 1, 0};
  scene.cloths = {upper, upper};
  scene.cloths[1].numWidthPoints = otherColumns;
  scene.cloths[1].position.y = 1 - upper.height - gap;
  Seam seam;
  seam.a = {0, {GridSide::bottom}};
  seam.b = {1, {GridSide::top}};
  scene.seams = {seam};
  return scene;
}

Scene inSteps(Scene scene, Integrator integrator) {
  scene.solver.integrator = integrator;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = isImplicit(integrator) ? 2 : 40;
  scene.solver.newtonSteps = 8;
  scene.solver.cgIterations = 60;
  scene.solver.tolerance = 1e-4;
  scene.solver.selfCollision = SelfCollision::off;
  return scene;
}

// The mean distance of the particles that a scene's seams join, downwards.
double gapOf(const Cloth& cloth, const State& state) {
  double sum = 0;
  for (const SeamSpring& spring : cloth.seams())
    sum +=
        static_cast<double>(state.positions[spring.a].y) - static_cast<double>(state.positions[spring.b].y);
  return sum / static_cast<double>(cloth.seams().size());
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> pairsOf(const Scene& scene) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const Cloth cloth(scene);
  for (const SeamSpring& spring : cloth.seams()) pairs.emplace_back(spring.a, spring.b);
  return pairs;
}

TEST(Seams, JoinPointByPointWhereBothSidesHaveAsMany) {
  // The bottom of a standing sheet is its row 0, the top its last.
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(pairsOf(twoStrips(3, 3, 0.1)), (Pairs{{0, 15}, {1, 16}, {2, 17}}));
  Scene reversed = twoStrips(3, 3, 0.1);
  reversed.seams[0].b.reverse = true;
  EXPECT_EQ(pairsOf(reversed), (Pairs{{0, 17}, {1, 16}, {2, 15}}));
}

TEST(Seams, JoinEachPointOfTheFinerSideToTheOneAsFarAlong) {
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(pairsOf(twoStrips(5, 3, 0.1)), (Pairs{{0, 21}, {1, 22}, {2, 22}, {3, 23}, {4, 23}}));
  EXPECT_EQ(pairsOf(twoStrips(3, 5, 0.1)), (Pairs{{0, 19}, {1, 20}, {1, 21}, {2, 22}, {2, 23}}));
}

TEST(Seams, StayAtTheirPlacesWhenTheResolutionChanges) {
  Scene scene = twoStrips(5, 5, 0.1);
  scene.seams[0].a.points = {GridRange{{0, 0}, {2, 0}}};
  (void)changeResolution(scene, 9, 5, true);
  EXPECT_EQ(scene.seams[0].a.points, (std::vector<Pin>{GridRange{{0, 0}, {4, 0}}}));
  EXPECT_EQ(Cloth(scene).seams().size(), 9u) << "the finer side has all its points sewn";
}

TEST(Seams, CloseAStripToATube) {
  Scene scene = twoStrips(3, 3, 0.1);
  scene.seams[0].a = {0, {GridSide::left}};
  scene.seams[0].b = {0, {GridSide::right}};
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(pairsOf(scene), (Pairs{{0, 2}, {3, 5}, {6, 8}}));
}

TEST(Seams, MakeOnePlaceOfAllPointsThatTheyJoin) {
  using Joints = std::vector<std::uint32_t>;
  const auto jointsOf = [](const Scene& scene) {
    const Joints all = seamJoints(Cloth(scene));
    return Joints(all.begin(), all.begin() + 3);
  };
  EXPECT_EQ(jointsOf(twoStrips(3, 3, 0.1)), (Joints{0, 1, 2}));
  Scene tube = twoStrips(3, 3, 0.1);
  tube.seams.push_back(tube.seams[0]);
  tube.seams[1].b = {1, {GridSide::top}, true};
  EXPECT_EQ(jointsOf(tube), (Joints{0, 1, 0})) << "by way of the points 15 and 17 of the other";
}

// A strip of weight W on n springs of stiffness k: the gap is W / (n k).
TEST(Seams, CarryALoadWithTheGapThatHookesLawGives) {
  constexpr double STIFFNESS = 40;
  for (const Integrator integrator : {Integrator::verlet, Integrator::implicit}) {
    Scene scene = inSteps(twoStrips(3, 3, 0.1), integrator);
    scene.cloths[0].pinned = {GridRange{{0, 0}, {2, 2}}};
    scene.cloths[1].damping = 1;
    scene.seams[0].stiffness = STIFFNESS;
    scene.seams[0].time = 0.2;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(3 * 60 * scene.solver.simulationSteps);
    const double weight = 9.8 * 1 * 0.2 * 0.2;
    EXPECT_NEAR(gapOf(cloth, solver.state()), weight / (3 * STIFFNESS), 2e-5) << integratorName(integrator);
  }
}

// Borders have half the mass, corners a quarter.
TEST(Seams, AreStableInTheExplicitStepsThatAutoChooses) {
  Scene scene = inSteps(twoStrips(3, 3, 0.1), Integrator::verlet);
  for (ClothSettings& cloth : scene.cloths) cloth.material = materialPreset("cotton");
  scene.gravity = {};
  double ofCloths = INFINITY;
  for (const ClothSettings& cloth : scene.cloths) ofCloths = std::min(ofCloths, stableStep(cloth));
  EXPECT_LT(stableStep(scene), 0.8 * ofCloths);
  scene.solver.simulationSteps = stableSteps(scene);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(40 * scene.solver.simulationSteps);
  EXPECT_FALSE(solver.divergence().has_value());
}

TEST(Seams, AreSaidToGapeOnceTheyHaveBeenClosedForAWhile) {
  Scene scene = inSteps(twoStrips(3, 3, 0.1), Integrator::implicit);
  scene.seams[0].time = 0.2;
  scene.seams[0].stiffness = 40;
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  EXPECT_NEAR(measure(cloth, scene, state).seamGap, 0, 1e-6) << "as far apart as the seam begins";
  state.clock.originTime = 0.1;
  EXPECT_NEAR(measure(cloth, scene, state).seamGap, 0.05, 1e-5) << "half closed";
  EXPECT_FALSE(seamWarning(6, cloth, scene, state));
  state.clock.originTime = 0.3;
  EXPECT_FALSE(seamWarning(18, cloth, scene, state)) << "it may still swing";
  state.clock.originTime = 0.5;
  const std::optional<Warning> warning = seamWarning(30, cloth, scene, state);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->text.find("seams.0 joins are 100 mm apart though it is closed; raise "
                               "seams.0.stiffness (now 40 N/m)"),
            std::string::npos)
      << warning->text;
}

// Without other forces the gap follows the rest length, which falls evenly to 0.
TEST(Seams, CloseEvenlyInTheirTime) {
  for (const Integrator integrator : {Integrator::euler, Integrator::implicit}) {
    Scene scene = inSteps(twoStrips(3, 3, 0.1), integrator);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].pinned = {GridRange{{0, 0}, {2, 2}}};
    scene.cloths[1].damping = 1;
    scene.seams[0].time = 1;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(30 * scene.solver.simulationSteps);
    EXPECT_NEAR(gapOf(cloth, solver.state()), 0.05, 0.004) << integratorName(integrator);
    solver.step(60 * scene.solver.simulationSteps);
    EXPECT_NEAR(gapOf(cloth, solver.state()), 0, 1e-3) << integratorName(integrator);
  }
}

TEST(Seams, PullBothSidesByAsMuch) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::implicit}) {
    Scene scene = inSteps(twoStrips(4, 3, 0.1), integrator);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].damping = scene.cloths[1].damping = 0;
    scene.seams[0].time = 0.3;
    const Cloth cloth(scene);
    CpuSolver<double> solver(cloth, scene);
    solver.step(9 * scene.solver.simulationSteps);
    Vec3d momentum, absolute;
    const State state = solver.state();
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      const Vec3d own = cloth.massOf(i) * vectorOf(state.velocities[i]);
      momentum = momentum + own;
      absolute = absolute + Vec3d{std::abs(own.x), std::abs(own.y), std::abs(own.z)};
    }
    EXPECT_GT(absolute.y, 1e-3) << "they move";
    EXPECT_LT(length(momentum), 1e-3 * length(absolute)) << integratorName(integrator);
  }
}

// Points that are nearer than the contact distance, and would otherwise be held apart.
TEST(Seams, CloseBetweenPointsThatWouldCollide) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust, SelfCollision::contact}) {
    const bool isInside = mode == SelfCollision::contact;
    Scene scene = inSteps(twoStrips(3, 3, 0.1), isInside ? Integrator::implicit : Integrator::verlet);
    scene.solver.selfCollision = mode;
    for (ClothSettings& cloth : scene.cloths) cloth.thickness = 0.02;
    scene.cloths[0].pinned = {GridRange{{0, 0}, {2, 2}}};
    scene.cloths[1].damping = 1;
    scene.gravity = {0, 0, 0};
    scene.seams[0].time = 0.3;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(40 * scene.solver.simulationSteps);
    EXPECT_LT(std::abs(gapOf(cloth, solver.state())), 1e-3) << selfCollisionName(mode);
  }
}

TEST(Seams, HoldWherePointsAreAtOnePlaceFromTheStart) {
  for (const auto& [integrator, mode] : {std::pair{Integrator::verlet, SelfCollision::off},
                                         std::pair{Integrator::implicit, SelfCollision::off},
                                         std::pair{Integrator::implicit, SelfCollision::contact}}) {
    Scene scene = inSteps(twoStrips(3, 3, 0), integrator);
    scene.solver.selfCollision = mode;
    scene.cloths[0].pinned = {GridSide::top};
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(60 * scene.solver.simulationSteps);
    const State state = solver.state();
    for (const Particle4& x : state.positions) EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(x.y));
    EXPECT_LT(std::abs(gapOf(cloth, state)), 1e-3) << integratorName(integrator);
  }
}

// 18 a Newton step; 29 where the coarse levels of the preconditioner know nothing of seams.
TEST(Seams, CostFewIterationsOfImplicitSteps) {
  Scene scene = loadSceneByName("pillow");
  (void)changeResolution(scene, 13, 13, true);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(36);
  const ConvergenceCounts counts = solver.convergenceCounts();
  EXPECT_EQ(counts.unconvergedSteps, 0u);
  EXPECT_LT(counts.iterations, 23 * counts.newtonSteps);
}

}  // namespace
}  // namespace clothsim
