// The numeric contract: the GPU and the CPU agree in every bit, whatever the work groups, whichever passes
// are fused.
#include "solver/gpu/gpu_solver.h"

#include <gtest/gtest.h>

#include "app/compare.h"
#include "gl/gl_test.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"

namespace clothsim {
namespace {

using GpuSolverTest = GlTest;

State steppedOnGpu(const Scene& scene, int steps, const GpuOptions& options = {}) {
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene, options);
  solver.step(steps);
  return solver.state();
}

State steppedOnCpu(const Scene& scene, int steps) {
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(steps);
  return solver.state();
}

TEST_F(GpuSolverTest, AgreesWithTheCpuInEveryBit) {
  for (const auto& [name, scene] : test::comparedScenes(33)) {
    const StateDifference result = difference(steppedOnGpu(scene, 500), steppedOnCpu(scene, 500));
    EXPECT_EQ(result.differing, 0u) << name << ", of " << result.floats << " floats, by at most "
                                    << result.maxAbs;
    EXPECT_TRUE(result.finite) << name;
  }
}

TEST_F(GpuSolverTest, AgreesWithTheCpuOnGridsOfEveryShape) {
  for (const auto& [columns, rows] :
       {std::pair{2, 2}, {3, 17}, {17, 3}, {65, 2}, {64, 64}, {1, 40}, {40, 1}, {129, 5}}) {
    Scene scene = test::withWind(test::withLimiter(test::sheetScene(2)));
    scene.cloths[0].numWidthPoints = columns;
    scene.cloths[0].numHeightPoints = rows;
    scene.cloths[0].pinned = {GridPoint{0, 0}};
    scene.solver.simulationSteps = 100;
    EXPECT_EQ(difference(steppedOnGpu(scene, 200), steppedOnCpu(scene, 200)).differing, 0u)
        << columns << "x" << rows;
  }
}

TEST_F(GpuSolverTest, GivesTheSameBitsFusedAndPassByPass) {
  for (const auto& [name, scene] : test::comparedScenes(20))
    EXPECT_EQ(difference(steppedOnGpu(scene, 200), steppedOnGpu(scene, 200, {.fused = false})).differing, 0u)
        << name;
}

TEST_F(GpuSolverTest, GivesTheSameBitsAtEveryWorkGroupSize) {
  const Scene scene = test::comparedScenes(37)[5].scene;
  const std::uint64_t usual = stateHash(steppedOnGpu(scene, 200));
  for (const auto& [columns, rows] : {std::pair{1, 1}, {8, 8}, {16, 4}, {128, 1}, {256, 1}})
    EXPECT_EQ(stateHash(steppedOnGpu(scene, 200, {.groupColumns = columns, .groupRows = rows})), usual)
        << columns << "x" << rows;
}

TEST_F(GpuSolverTest, DoesNotDependOnHowStepsAreBatched) {
  const Scene scene =
      test::comparedScenes(16)[5].scene;  // time-dependent: parameters are uploaded in batches
  const Cloth cloth(scene);
  GpuSolver whole(cloth, scene), pieces(cloth, scene);
  whole.step(300);
  for (const int count : {1, 62, 1, 64, 65, 107}) pieces.step(count);
  EXPECT_EQ(stateHash(whole.state()), stateHash(pieces.state()));
}

TEST_F(GpuSolverTest, HandsItsStateToTheCpuAndBackWithoutChangingABitOfWhatFollows) {
  for (const auto& [name, scene] : test::comparedScenes(20)) {
    const Cloth cloth(scene);
    GpuSolver gpu(cloth, scene);
    CpuSolver<float> cpu(cloth, scene);
    gpu.step(61);
    cpu.setState(gpu.state());
    cpu.step(40);
    gpu.setState(cpu.state());
    gpu.step(99);
    EXPECT_EQ(difference(gpu.state(), steppedOnCpu(scene, 200)).differing, 0u) << name;
  }
}

TEST_F(GpuSolverTest, SwitchesIntegratorsInMidSwingAsTheCpuDoes) {
  const Scene scene = test::comparedScenes(20)[5].scene;
  Scene other = scene;
  other.solver.integrator = Integrator::euler;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->step(50);
    solver->configure(other);
    solver->step(50);
    solver->configure(scene);
    solver->step(50);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
}

TEST_F(GpuSolverTest, TakesLiveEditsFromTheNextStepOn) {
  const Scene scene = test::vertical(test::sheetScene(20));
  Scene windy = test::withWind(test::withLimiter(scene));
  windy.gravity = {1, -5, 0};
  windy.cloths[0].damping = 3;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->step(70);
    solver->configure(windy);
    solver->step(70);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_NE(stateHash(gpu.state()), stateHash(steppedOnGpu(scene, 140))) << "the edit did something";
}

TEST_F(GpuSolverTest, TimesItsPasses) {
  const Scene scene = test::withLimiter(test::vertical(test::sheetScene(64)));
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene, {.fused = false});
  const std::vector<PassTime> times = solver.timePasses(3);
  std::vector<std::string> names;
  for (const PassTime& time : times) {
    names.push_back(time.name);
    EXPECT_GT(time.seconds, 0) << time.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"forces", "integrate", "collide", "limit"}));
  EXPECT_EQ(solver.stepIndex(), 3u);
}

}  // namespace
}  // namespace clothsim
