// Contact of cloth with cloth on the GPU: pairs, the room for them, and what friction remembers of them.
#include <gtest/gtest.h>

#include "cloth/material.h"
#include "gl/gl_test.h"
#include "simulation/compare.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/gpu/gpu_solver.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using GpuContactTest = GlTest;

// Layers upon layers on a leaning plane.
Scene sceneOfLayers(int layers, int points) {
  Scene scene = test::materialSheet(points, points, 0.005 * (points - 1), 0.005 * (points - 1),
                                    *materialPreset("cotton"));
  scene.solver.integrator = Integrator::implicit;
  scene.solver.selfCollision = SelfCollision::contact;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 2;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.gravity = {1.7, -9.65, 0};
  scene.colliders = {Plane{.point = {0, 1, 0}, .normal = {0, 1, 0}, .friction = 0.5}};
  scene.cloths.resize(layers, scene.cloths[0]);
  for (int i = 0; i < layers; ++i) {
    scene.cloths[i].position = {0, 0.0003 + 0.0003 * i, 0};
    scene.cloths[i].rotation = {0, 11.0 * i, 0};
  }
  return scene;
}

// Between frames the GPU makes room for more pairs; what friction remembers of those that were there stays.
TEST_F(GpuContactTest, RemembersFrictionWhereThereIsMoreRoomForPairs) {
  const Scene scene = sceneOfLayers(3, 7);
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (int frame = 0; frame < 4; ++frame) {
    for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) {
      solver->step(2);
      EXPECT_FALSE(solver->divergence().has_value());
    }
    const State onGpu = gpu.state(), onCpu = cpu.state();
    ASSERT_EQ(difference(onGpu, onCpu).differing, 0u) << frame;
    ASSERT_EQ(onGpu.pairSlips.size(), onCpu.pairSlips.size());
  }
  EXPECT_GT(cpu.contactCounts().pairs, 4 * cloth.particleCount()) << "more than half of the room at first";
}

// What touched before says nothing of the steps after: they are those of a solver that is made for them.
TEST_F(GpuContactTest, ForgetsWhatTouchedWhenContactIsSwitchedOff) {
  const Scene scene = sceneOfLayers(3, 5);
  Scene off = scene;
  off.solver.selfCollision = SelfCollision::off;
  off.colliders.clear();
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene), freshGpu(cloth, off);
  CpuSolver<float> cpu(cloth, scene), freshCpu(cloth, off);
  const auto compare = [&](Solver& solver, Solver& fresh) {
    solver.step(2);
    const State touching = solver.state();
    EXPECT_FALSE(touching.pairSlips.empty());
    EXPECT_GT(solver.contactCounts().pairs, 0u);
    solver.configure(off);
    fresh.setState(touching);
    for (Solver* each : {&solver, &fresh}) each->step(2);
    EXPECT_EQ(difference(solver.state(), fresh.state()).differing, 0u) << solver.backend();
    EXPECT_TRUE(solver.state().pairSlips.empty());
  };
  compare(gpu, freshGpu);
  compare(cpu, freshCpu);
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_GT(gpu.contactCounts().pairs, 0u) << "what was counted stays counted";
}

TEST_F(GpuContactTest, MakesStepsAgainThatHadTooLittleRoomForPairs) {
  const Scene scene = sceneOfLayers(5, 4);
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) {
    solver->step(1);
    solver->step(1);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_GT(cpu.contactCounts().pairs, 8 * cloth.particleCount()) << "more than the room at first";
  EXPECT_EQ(gpu.contactCounts().pairs, cpu.contactCounts().pairs);
  EXPECT_EQ(gpu.contactCounts().crowdedSteps, 0u);
  EXPECT_EQ(gpu.convergenceCounts().steps, 2u) << "those made again count once";
}

}  // namespace
}  // namespace clothsim
