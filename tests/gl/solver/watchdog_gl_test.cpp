// The watchdog on the GPU: the same divergences under the same names as on the CPU, without a read-back in a
// step.
#include <gtest/gtest.h>

#include <limits>

#include "gl/gl_test.h"
#include "simulation/compare.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/gpu/gpu_solver.h"
#include "support/compared_scenes.h"
#include "support/injections.h"

namespace clothsim {
namespace {

using WatchdogTest = GlTest;

TEST_F(WatchdogTest, FindsTwoHundredInjectedInfinitiesAndNansInTheNextStep) {
  const Scene scene = test::twoCloths(
      test::withWind(test::withColliders(test::withLimiter(test::vertical(test::sheetScene(12))))));
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (const test::Injection& injection : test::makeInjections(cloth, 200)) {
    gpu.setState(initialState(cloth, scene));
    gpu.step(injection.step);
    ASSERT_EQ(gpu.divergence(), std::nullopt);
    const State wrong = injection.into(gpu.state());
    gpu.setState(wrong);
    cpu.setState(wrong);
    gpu.step(1);
    cpu.step(1);
    const Divergence expected{DivergenceReason::nonFinite, Pass::checkStart,
                              static_cast<std::uint64_t>(injection.step) + 1, injection.particle};
    EXPECT_EQ(gpu.divergence(), expected) << injection.text();
    EXPECT_EQ(cpu.divergence(), expected) << injection.text();
  }
}

TEST_F(WatchdogTest, NamesTheDivergenceOfExplodingScenesAsTheCpuDoesFusedAndPassByPass) {
  for (const auto& [name, scene] : test::fullestScenes(16)) {
    const Scene wild = test::exploding(scene);
    const Cloth cloth(wild);
    GpuSolver fused(cloth, wild), separate(cloth, wild, {.fused = false});
    CpuSolver<float> cpu(cloth, wild);
    for (Solver* solver :
         {static_cast<Solver*>(&fused), static_cast<Solver*>(&separate), static_cast<Solver*>(&cpu)})
      solver->step(60);
    EXPECT_TRUE(cpu.divergence().has_value()) << name;
    EXPECT_EQ(fused.divergence(), cpu.divergence()) << name;
    EXPECT_EQ(separate.divergence(), cpu.divergence()) << name;
  }
}

// One scene for each pass, made so that divergence begins there.
TEST_F(WatchdogTest, NamesThePassInWhichDivergenceBegan) {
  const Scene calm = test::withLimiter(test::vertical(test::sheetScene(12)));
  const auto divergenceOf = [](const Scene& scene, const State& start) {
    const Cloth cloth(scene);
    GpuSolver gpu(cloth, scene);
    CpuSolver<float> cpu(cloth, scene);
    for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
      solver->setState(start);
      solver->step(2);
    }
    EXPECT_EQ(gpu.divergence(), cpu.divergence());
    return gpu.divergence();
  };
  const State rest = initialState(Cloth(calm), calm);

  State stretched = rest;
  stretched.positions[40].z += 15;  // 165 times the spacing
  EXPECT_EQ(divergenceOf(calm, stretched),
            (Divergence{DivergenceReason::runawayStrain, Pass::forces, 1, 40}));

  State fast = rest;
  fast.velocities[17].y = 20'000;
  EXPECT_EQ(divergenceOf(calm, fast), (Divergence{DivergenceReason::runawaySpeed, Pass::integrate, 1, 17}));

  // Within the limits until the strain limit pulls the particle back in one step of 1/2700 s.
  State pulled = rest;
  pulled.positions[70].z += 5;
  const std::optional<Divergence> byLimit = divergenceOf(calm, pulled);
  ASSERT_TRUE(byLimit.has_value());
  EXPECT_EQ(byLimit->pass, Pass::limit);
  EXPECT_EQ(byLimit->reason, DivergenceReason::runawaySpeed);

  // A ball that swallows the sheet and pushes it out to its surface, 20 m away, in one step.
  Scene ball = calm;
  ball.colliders = {Sphere{.origin = {0.4, 0.5, 0}, .radius = 20, .friction = 0, .motion = std::nullopt}};
  const std::optional<Divergence> byBall = divergenceOf(ball, rest);
  ASSERT_TRUE(byBall.has_value());
  EXPECT_EQ(byBall->pass, Pass::collide);

  Scene other = calm;  // the velocities of the half step before are converted first
  other.solver.integrator = Integrator::euler;
  EXPECT_EQ(divergenceOf(other, fast), (Divergence{DivergenceReason::runawaySpeed, Pass::kick, 1, 17}));
}

TEST_F(WatchdogTest, FindsTheVeryStepInAnyNumberOfStepsBetweenTwoLooks) {
  Scene scene = test::vertical(test::sheetScene(8));
  scene.cloths[0].pinned.clear();  // falls freely: v = n h g
  scene.gravity = {0, -10, 0};
  scene.cloths[0].damping = 0;
  scene.solver.framesPerSec = 100;
  scene.solver.simulationSteps = 10;
  scene.solver.maxSpeed = 25;  // after 2500 steps of 0.01 m/s
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  gpu.step(3000);
  cpu.step(3000);
  ASSERT_TRUE(cpu.divergence().has_value());
  EXPECT_NEAR(static_cast<double>(cpu.divergence()->step), 2500, 3);
  EXPECT_EQ(gpu.divergence(), cpu.divergence());
  gpu.step(2000);
  EXPECT_EQ(gpu.divergence(), cpu.divergence()) << "the first one stays";
}

TEST_F(WatchdogTest, LooksForNoContactsAfterDivergenceUntilItIsReverted) {
  Scene scene = test::sheetScene(12);
  scene.cloths[0].thickness = 0.03;
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    scene.solver.selfCollision = mode;
    const Cloth cloth(scene);
    GpuSolver gpu(cloth, scene);
    CpuSolver<float> cpu(cloth, scene);
    gpu.step(3);
    gpu.keep();
    State heap = gpu.state();
    for (Particle4& x : heap.positions) x = {1e6f, 0, 0, x.w};
    heap.velocities[5].y = std::numeric_limits<float>::quiet_NaN();
    const std::uint64_t builds = gpu.contactCounts().hashBuilds;
    gpu.setState(heap);
    cpu.setState(heap);
    gpu.step(20);
    cpu.step(20);
    ASSERT_TRUE(gpu.divergence().has_value());
    EXPECT_EQ(gpu.divergence(), cpu.divergence());
    EXPECT_EQ(gpu.contactCounts().hashBuilds, builds);
    gpu.revert();
    gpu.step(20);
    CpuSolver<float> undisturbed(cloth, scene);
    undisturbed.step(23);
    EXPECT_GT(gpu.contactCounts().hashBuilds, builds) << "contacts are looked for again";
    EXPECT_EQ(difference(gpu.state(), undisturbed.state()).differing, 0u);
  }
}

TEST_F(WatchdogTest, RevertGoesBackToWhatWasKeptAndForgetsTheDivergence) {
  const Scene scene = test::withWind(test::vertical(test::sheetScene(12)));
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  gpu.step(7);
  gpu.keep();
  const State kept = gpu.state();
  State wrong = kept;
  wrong.positions[3].x = std::numeric_limits<float>::quiet_NaN();
  wrong.clock.step = 1000;
  gpu.setState(wrong);
  gpu.step(5);
  ASSERT_TRUE(gpu.divergence().has_value());
  gpu.revert();
  EXPECT_EQ(gpu.divergence(), std::nullopt);
  EXPECT_EQ(gpu.stepIndex(), 7u);
  EXPECT_EQ(difference(gpu.state(), kept).differing, 0u);
  gpu.step(10);
  CpuSolver<float> cpu(cloth, scene);
  cpu.step(17);
  EXPECT_EQ(gpu.divergence(), std::nullopt);
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
}

}  // namespace
}  // namespace clothsim
