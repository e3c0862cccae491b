// The watchdog on the CPU backend: what it finds, what it calls it, and what it leaves alone.
#include "solver/divergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cloth/material.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "support/injections.h"
#include "support/mesh_sheet.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

Scene twoBusyCloths(int n) {
  return test::twoCloths(
      test::withWind(test::withColliders(test::withLimiter(test::vertical(test::sheetScene(n))))));
}

TEST(Watchdog, FindsNonFiniteNumbersInjectedAnywhereInTheNextStepAndNamesTheParticle) {
  const Scene scene = twoBusyCloths(12);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  for (const test::Injection& injection : test::makeInjections(cloth, 200)) {
    solver.setState(initialState(cloth, scene));
    solver.step(injection.step);
    ASSERT_EQ(solver.divergence(), std::nullopt);
    solver.setState(injection.into(solver.state()));
    solver.step(1);
    const Divergence expected{DivergenceReason::nonFinite, Pass::checkStart,
                              static_cast<std::uint64_t>(injection.step) + 1, injection.particle};
    EXPECT_EQ(solver.divergence(), expected) << injection.text();
  }
}

TEST(Watchdog, IsSilentOnEverySceneThatTheBackendsAreComparedOn) {
  for (const auto& [name, scene] : test::comparedScenes(20)) {
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(60);
    EXPECT_EQ(solver.divergence(), std::nullopt) << name;
  }
}

TEST(Watchdog, IsSilentInImplicitStepsWhichTakeAnyStiffness) {
  for (const auto& [name, scene] : test::implicitScenes(16)) {
    const Scene stiff = test::exploding(scene);
    const Cloth cloth(stiff);
    CpuSolver<float> solver(cloth, stiff);
    solver.step(60);
    EXPECT_EQ(solver.divergence(), std::nullopt) << name;
  }
}

TEST(Watchdog, StopsASheetThatExplodesWithinAFewStepsWhileAllNumbersAreStillFinite) {
  const Scene scene = test::exploding(test::vertical(test::sheetScene(20)));
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  int steps = 0;
  while (!solver.divergence() && steps < 20) solver.step(1), ++steps;
  ASSERT_TRUE(solver.divergence().has_value());
  EXPECT_NE(solver.divergence()->reason, DivergenceReason::nonFinite);
  EXPECT_EQ(solver.divergence()->step, static_cast<std::uint64_t>(steps));
  for (const Particle4& x : solver.state().positions)
    EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z));
}

TEST(Watchdog, KeepsToTheFirstDivergenceUntilAnotherStateIsHandedIn) {
  const Scene scene = test::exploding(test::vertical(test::sheetScene(20)));
  const Cloth cloth(scene);
  CpuSolver<float> whole(cloth, scene), stepwise(cloth, scene);
  whole.step(100);
  const std::optional<Divergence> first = whole.divergence();
  while (!stepwise.divergence()) stepwise.step(1);
  EXPECT_EQ(first, stepwise.divergence());
  whole.setState(initialState(cloth, scene));
  EXPECT_EQ(whole.divergence(), std::nullopt);
}

// One particle of a single spring, thrown at a speed on either side of the limit.
TEST(Watchdog, HoldsSpeedsToMaxSpeed) {
  Scene scene = test::springScene(1, 1, 1, 1e-3, Integrator::euler);
  scene.solver.maxSpeed = 50;
  const Cloth cloth(scene);
  for (const double speed : {49.9, 50.1}) {
    CpuSolver<double> solver(cloth, scene);
    solver.setVelocity(1, {speed, 0, 0});
    solver.step(1);
    if (speed < 50)
      EXPECT_EQ(solver.divergence(), std::nullopt);
    else
      EXPECT_EQ(solver.divergence(), (Divergence{DivergenceReason::runawaySpeed, Pass::integrate, 1, 1}));
  }
}

TEST(Watchdog, HoldsSpringsToMaxStrain) {
  Scene scene = test::springScene(1, 1, 1, 1e-3, Integrator::euler);
  scene.solver.maxStrain = 2;
  const Cloth cloth(scene);
  for (const double length : {2.99, 3.01}) {
    CpuSolver<double> solver(cloth, scene);
    solver.setPosition(1, {0, -length, 0});
    solver.step(1);
    if (length < 3)
      EXPECT_EQ(solver.divergence(), std::nullopt);
    else
      EXPECT_EQ(solver.divergence(), (Divergence{DivergenceReason::runawayStrain, Pass::forces, 1, 1}));
  }
}

TEST(Watchdog, NamesTheSamePlaceFusedAndPassByPass) {
  for (const auto& [name, scene] : test::comparedScenes(16)) {
    const Scene wild = test::exploding(scene);
    const Cloth cloth(wild);
    CpuSolver<float> fused(cloth, wild, true), separate(cloth, wild, false);
    fused.step(60);
    separate.step(60);
    EXPECT_EQ(fused.divergence(), separate.divergence()) << name;
    EXPECT_TRUE(fused.divergence().has_value()) << name;
  }
}

TEST(Watchdog, RevertGoesBackToWhatWasKeptAndForgetsTheDivergence) {
  const Scene scene = test::withWind(test::vertical(test::sheetScene(12)));
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene), straight(cloth, scene);
  solver.step(7);
  solver.keep();
  solver.step(3);
  solver.setVelocity(5, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
  solver.step(1);
  ASSERT_TRUE(solver.divergence().has_value());
  solver.revert();
  EXPECT_EQ(solver.divergence(), std::nullopt);
  EXPECT_EQ(solver.stepIndex(), 7u);
  solver.step(10);
  straight.step(17);
  EXPECT_EQ(stateHash(solver.state()), stateHash(straight.state()));
}

TEST(Watchdog, TakesANegativeZeroForTheNumberThatItIs) {
  const Scene scene = test::sheetScene(4);
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  state.positions[5].x = state.velocities[6].y = -0.0f;
  CpuSolver<float> solver(cloth, scene);
  solver.setState(state);
  solver.step(1);
  EXPECT_EQ(solver.divergence(), std::nullopt);
}

TEST(Watchdog, EndsAtTheStepWithDivergenceAndLooksForNoContactsInBrokenNumbers) {
  Scene scene = test::sheetScene(12);
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    scene.solver.selfCollision = mode;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.step(3);
    const std::uint64_t builds = solver.contactCounts().hashBuilds;
    ASSERT_GT(builds, 0u);
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)  // one heap, out of reach of the last hash
      solver.setPosition(i, {1e6f, 0, 0});
    solver.setVelocity(5, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
    solver.step(50);
    ASSERT_TRUE(solver.divergence().has_value());
    EXPECT_EQ(solver.divergence()->step, 4u);
    EXPECT_EQ(solver.stepIndex(), 4u);
    EXPECT_EQ(solver.contactCounts().hashBuilds, builds);
  }
}

TEST(FirstDivergence, IsTheEarliestPassWhateverWasNotedAfterIt) {
  WatchRow row = soundWatchRow();
  EXPECT_EQ(firstDivergence(row, 3), std::nullopt);
  row[PASS_LIMIT] = 4 * 1 + REASON_NON_FINITE;
  row[PASS_INTEGRATE] = 4 * 9 + REASON_RUNAWAY_SPEED;
  EXPECT_EQ(firstDivergence(row, 3), (Divergence{DivergenceReason::runawaySpeed, Pass::integrate, 3, 9}));
}

TEST(DivergenceText, NamesStepFramePassParticleAndItsPlaceOnTheCloth) {
  const Scene scene = twoBusyCloths(12);
  const Cloth cloth(scene);
  const std::uint32_t particle = cloth.pieces()[1].particle(4, 2);
  const std::string text =
      divergenceText({DivergenceReason::runawaySpeed, Pass::collide, 61, particle}, cloth, scene);
  EXPECT_NE(text.find("step 61 (frame 3)"), std::string::npos) << text;
  EXPECT_NE(divergenceText({DivergenceReason::runawaySpeed, Pass::collide, 61, particle}, cloth, scene, 7)
                .find("step 61 (frame 7)"),
            std::string::npos);
  EXPECT_NE(text.find("pass collide"), std::string::npos) << text;
  EXPECT_NE(text.find("particle " + std::to_string(particle) + " (cloth 1, column 4, row 2)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("solver.max_speed, 10000 m/s"), std::string::npos) << text;
}

TEST(DivergenceText, NamesAVertexAsTheFileOfItsMeshCounts) {
  Scene scene;
  scene.cloths[0].mesh = test::meshFile("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 2 3 4\n");
  const Divergence divergence{DivergenceReason::runawaySpeed, Pass::integrate, 1, 0};
  EXPECT_NE(divergenceText(divergence, Cloth(scene), scene).find("(cloth 0, vertex 1)"), std::string::npos)
      << "the file's first point is of no face";
}

// The shortest scene of a fabric, and what the watchdog proposes where somebody sets CS184's steps for it.
TEST(Remedy, IsNotNeededByTheShortestSceneOfAFabricAndHelpsWhereStepsAreTooLong) {
  for (const std::string& name : materialPresetNames()) {
    Scene scene = test::sceneOf(R"({"cloth": {"width": 1, "height": 1, "material": ")" + name +
                                R"(", "num_width_points": 25, "num_height_points": 25, "pinned": ["top"]}})");
    const Cloth cloth(scene);
    const auto divergenceIn = [&](int steps) {
      CpuSolver<float> solver(cloth, scene);
      solver.step(steps);
      return solver.divergence();
    };
    EXPECT_EQ(divergenceIn(1), std::nullopt) << name;
    setSceneValue(scene, "solver.integrator=verlet");
    setSceneValue(scene, "solver.simulation_steps=1");
    const std::optional<Divergence> divergence = divergenceIn(30);
    ASSERT_TRUE(divergence.has_value()) << name;
    for (const std::string& setting : remedyFor(*divergence, scene).settings) setSceneValue(scene, setting);
    EXPECT_LE(stepLength(scene.solver), stableStep(scene)) << name;
  }
}

TEST(Remedy, KeepsCs184sIntegratorWhereAStableNumberOfStepsIsNear) {
  const Divergence divergence{DivergenceReason::runawaySpeed, Pass::integrate, 1, 0};
  Scene scene = test::sceneOf(R"({"cloth": {"ks": 500000}})");
  const Remedy steps = remedyFor(divergence, scene);
  const std::string setting = "solver.simulation_steps=" + std::to_string(stableSteps(scene));
  EXPECT_EQ(steps.settings, std::vector{setting});
  EXPECT_NE(steps.text.find(setting + " (now 30)"), std::string::npos) << steps.text;
  scene.cloths[0].ks = 5e9;
  EXPECT_EQ(remedyFor(divergence, scene).settings, std::vector<std::string>{"solver.integrator=implicit"});
  scene.cloths[0].ks = 5000;  // its steps are short enough
  EXPECT_NE(remedyFor(divergence, scene).text.find("The springs are not the cause"), std::string::npos);
  scene.solver.integrator = Integrator::implicit;
  EXPECT_EQ(remedyFor(divergence, scene).settings, std::vector<std::string>{"solver.simulation_steps=120"});
}

}  // namespace
}  // namespace clothsim
