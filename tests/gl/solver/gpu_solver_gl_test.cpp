// The numeric contract: the GPU and the CPU agree in every bit, whatever the work groups, whichever passes
// are fused.
#include "solver/gpu/gpu_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/material.h"
#include "gl/gl_test.h"
#include "simulation/compare.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "support/material_sheet.h"
#include "support/scene_text.h"

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

void expectTheSameBits(const std::vector<test::NamedScene>& scenes, int steps) {
  for (const auto& [name, scene] : scenes) {
    const StateDifference result = difference(steppedOnGpu(scene, steps), steppedOnCpu(scene, steps));
    EXPECT_EQ(result.differing, 0u) << name << ", of " << result.floats << " floats, by at most "
                                    << result.maxAbs;
    EXPECT_TRUE(result.finite) << name;
  }
}

// Until what flies has met the cloth; layers meet later.
TEST_F(GpuSolverTest, AgreesWithTheCpuInEveryBit) {
  for (const test::NamedScene& named : test::comparedScenes(21))
    expectTheSameBits({named}, named.scene.solver.selfCollision == SelfCollision::off ? 70 : 140);
}

TEST_F(GpuSolverTest, AgreesWithTheCpuInEveryBitInImplicitSteps) {
  expectTheSameBits(test::implicitScenes(33), 12);
}

// In explicit steps with springs, limit and self-collision, in implicit ones with membranes, folds and
// contact.
TEST_F(GpuSolverTest, TearsMeshesAsTheCpuDoes) {
  Scene springs = test::meshWithEverything(12, SelfCollision::robust);
  springs.cloths[0].tearStrain = springs.cloths[1].tearStrain = 0.02;
  Scene both = springs;
  both.solver.selfCollision = SelfCollision::averaged;
  both.cloths = {springs.cloths[1], test::tornMesh(12).cloths[0]};
  Scene contact = test::implicitly(test::tornMesh(12));
  contact.solver.selfCollision = SelfCollision::contact;
  contact.solver.strainLimit = 0.2;
  const std::vector<test::NamedScene> scenes{{"springs", springs},
                                             {"fabric in contact", contact},
                                             {"both in second order", test::inSecondOrder(both)}};
  for (const auto& [name, scene] : scenes) {
    const int steps = isImplicit(scene.solver.integrator) ? 20 : 5 * scene.solver.simulationSteps;
    const State gpu = steppedOnGpu(scene, steps), cpu = steppedOnCpu(scene, steps);
    const StateDifference result = difference(gpu, cpu);
    EXPECT_EQ(result.differing, 0u) << name << ", by at most " << result.maxAbs;
    EXPECT_TRUE(result.finite) << name;
    EXPECT_EQ(gpu.cuts, cpu.cuts) << name;
    EXPECT_GT(std::count(cpu.cuts.begin(), cpu.cuts.end(), 1), 2) << name << " hardly tears";
  }
}

// A sheet of few cells falls on the tip of a cone, a board that stands on edge, a rod, and a ring that turns.
TEST_F(GpuSolverTest, AgreesWithTheCpuOnSmallColliders) {
  Scene scene = test::implicitly(test::sheetScene(9));
  scene.cloths[0].material = materialPreset("cotton");
  scene.cloths[0].position = {0, -1, 0};  // down to y = 0
  scene.colliders = {
      Cone{.origin = {0.3, -0.05, 0.3}, .height = 0.1, .radius = 0.03},
      Box{.origin = {0.7, -0.06, 0.3}, .size = {0.2, 0.11, 0.004}, .rounding = 0.001},
      Cylinder{.origin = {0.3, -0.03, 0.7}, .axis = {1, 0, 0.3}, .height = 0.2, .radius = 0.02},
      Torus{.axis = {1, 0, 0},
            .radius = 0.05,
            .tubeRadius = 0.01,
            .motion = Motion{.keys = {{0, {0.7, -0.07, 0.7}, {}}, {1, {0.7, 0.2, 0.7}, {0, 90, 0}}}}}};
  scene.solver.selfCollision = SelfCollision::off;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 2;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene, {});
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) solver->step(12);
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_EQ(gpu.contactCounts().pairs, cpu.contactCounts().pairs);
  EXPECT_GT(cpu.contactCounts().pairs, 20u);
  scene.colliders.clear();
  CpuSolver<float> fallsFreely(cloth, scene);
  fallsFreely.step(12);
  EXPECT_GT(difference(fallsFreely.state(), cpu.state()).differing, 0u) << "nothing was touched";
}

// The two ends of a strip pass each other: what hangs on them is in the way.
TEST_F(GpuSolverTest, KeepsBackPinsAsTheCpuDoes) {
  const Scene scene = test::sceneOf(
      R"({"cloth": {"width": 0.3, "height": 0.15, "num_width_points": 9, "num_height_points": 5, "material": "cotton",
                    "pinned": ["left", "right"],
                    "pin_motion": [{"pinned": ["left"], "keys": [{"t": 0}, {"t": 0.1, "position": [0.18, 1, 0.07]}]},
                                   {"pinned": ["right"], "keys": [{"t": 0}, {"t": 0.1, "position": [0.12, 1, 0.07]}]}]},
          "solver": {"frames_per_sec": 120, "simulation_steps": 1}})");
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene, {});
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) solver->step(14);
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_GT(cpu.contactCounts().pinLag, 0);
  EXPECT_EQ(gpu.contactCounts().pinLag, cpu.contactCounts().pinLag);
}

// A sheet with a cut falls into a heap on the floor, over a ball that is smaller than a cell and a rod that
// turns, sewn to another one along its upper border.
TEST_F(GpuSolverTest, AgreesWithTheCpuInContact) {
  Scene scene = test::implicitly(test::sheetScene(17));
  scene.cloths = {ClothSettings{}};
  scene.cloths[0].width = scene.cloths[0].height = 0.4;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 13;
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].rotation = {0, 0, 5};
  scene.cloths[0].position = {0, 0.01, 0};
  scene.cloths[0].material = materialPreset("cotton");
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].position.z = 0.01;
  scene.cloths[1].numWidthPoints = 11;
  scene.seams.resize(1);
  scene.seams[0].a = {0, {GridSide::top}};
  scene.seams[0].b = {1, {GridSide::top}};
  scene.colliders = {
      Plane{.point = {0, 0, 0}, .normal = {0, 1, 0}, .friction = 0.4},
      Sphere{.origin = {0.1, 0.02, 0}, .radius = 0.02, .friction = 0.4},
      Capsule{.axis = {1, 0, 0.2},
              .length = 0.2,
              .radius = 0.015,
              .friction = 0.4,
              .motion = Motion{.keys = {{0, {0.25, 0.02, 0}, {}}, {1, {0.25, 0.1, 0}, {0, 90, 0}}}}}};
  scene.solver.selfCollision = SelfCollision::contact;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 2;
  scene.solver.newtonSteps = 1;  // so few that motions have to be cut short
  scene.solver.cgIterations = 3;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  const Cloth cloth(scene);
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {6.3, -1}, {6.3, 5.5});
  GpuSolver gpu(cloth, scene, {});
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) {
    solver->step(8);  // whole grids are not searched where they are flat
    solver->setCuts(cuts);
    solver->step(4);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  const ContactCounts onGpu = gpu.contactCounts(), onCpu = cpu.contactCounts();
  EXPECT_GT(onCpu.pairs, 100u);
  EXPECT_GT(onCpu.shortened, 0u);
  EXPECT_EQ(onGpu.pairs, onCpu.pairs);
  EXPECT_EQ(onGpu.shortened, onCpu.shortened);
  EXPECT_EQ(onGpu.clampedSteps, onCpu.clampedSteps);
  EXPECT_EQ(onGpu.leastGap, onCpu.leastGap);
  EXPECT_EQ(onGpu.largestCorrection, onCpu.largestCorrection);
  EXPECT_EQ(onGpu.pinLag, onCpu.pinLag);
  gpu.forgetContactCounts();
  EXPECT_EQ(gpu.contactCounts().pairs + gpu.contactCounts().shortened, 0u);
}

TEST_F(GpuSolverTest, CountsStepsAndUpdatesAsTheCpuDoes) {
  for (const int newtonSteps : {2, 4}) {
    Scene scene = test::inSecondOrder(test::withColliders(test::sheetScene(17)));
    scene.solver.newtonSteps = newtonSteps;
    const Cloth cloth(scene);
    GpuSolver gpu(cloth, scene, {});
    CpuSolver<float> cpu(cloth, scene);
    gpu.step(12);
    cpu.step(12);
    const ConvergenceCounts onGpu = gpu.convergenceCounts(), onCpu = cpu.convergenceCounts();
    EXPECT_EQ(onCpu.steps, 12u);
    EXPECT_EQ(onGpu.steps, onCpu.steps);
    EXPECT_EQ(onGpu.unconvergedSteps, onCpu.unconvergedSteps);
    EXPECT_EQ(onGpu.newtonSteps, onCpu.newtonSteps);
    EXPECT_EQ(onGpu.iterations, onCpu.iterations);
    EXPECT_EQ(onGpu.lastUpdate, onCpu.lastUpdate);
    EXPECT_EQ(onGpu.secondOrderSteps, onCpu.secondOrderSteps);
    EXPECT_GT(onCpu.secondOrderSteps, 0u);
  }
}

TEST_F(GpuSolverTest, AgreesWithTheCpuInImplicitStepsOnGridsOfEveryShape) {
  for (const auto& [columns, rows] :
       {std::pair{2, 2}, {3, 17}, {65, 2}, {64, 64}, {1, 40}, {40, 1}, {129, 5}}) {
    Scene scene = test::implicitly(test::withWind(test::withLimiter(test::sheetScene(2))));
    scene.cloths[0].numWidthPoints = columns;
    scene.cloths[0].numHeightPoints = rows;
    scene.cloths[0].pinned = {GridPoint{0, 0}};
    EXPECT_EQ(difference(steppedOnGpu(scene, 10), steppedOnCpu(scene, 10)).differing, 0u)
        << columns << "x" << rows;
  }
}

// Next to the pins, an aggregate of such a strip turns as it moves, but for rounding: of its block, both
// backends leave out the same unknowns.
TEST_F(GpuSolverTest, AgreesWithTheCpuOnAFineStrip) {
  Scene scene =
      test::implicitly(test::vertical(test::materialSheet(3, 130, 0.0011, 0.071, *materialPreset("denim"))));
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 2; ++row) scene.cloths[0].pinned.push_back(GridPoint{column, row});
  EXPECT_EQ(difference(steppedOnGpu(scene, 3), steppedOnCpu(scene, 3)).differing, 0u);
}

TEST_F(GpuSolverTest, AgreesWithTheCpuOnGridsOfEveryShape) {
  for (const auto& [columns, rows] :
       {std::pair{2, 2}, {3, 17}, {17, 3}, {65, 2}, {64, 64}, {1, 40}, {40, 1}, {129, 5}}) {
    Scene scene = test::withWind(test::withLimiter(test::sheetScene(2)));
    scene.cloths[0].numWidthPoints = columns;
    scene.cloths[0].numHeightPoints = rows;
    scene.cloths[0].pinned = {GridPoint{0, 0}};
    scene.solver.simulationSteps = 100;
    // As here, and as on hardware.
    for (const GpuOptions& options :
         {GpuOptions{},
          GpuOptions{.groupColumns = 32, .groupRows = 8, .limitsInTiles = true, .storageLoads = true}})
      EXPECT_EQ(difference(steppedOnGpu(scene, 100, options), steppedOnCpu(scene, 100)).differing, 0u)
          << columns << "x" << rows;
  }
}

TEST_F(GpuSolverTest, GivesTheSameBitsFusedAndPassByPass) {
  for (const auto& [name, scene] : test::fullestScenes(20))
    EXPECT_EQ(difference(steppedOnGpu(scene, 30), steppedOnGpu(scene, 30, {.fused = false})).differing, 0u)
        << name;
}

TEST_F(GpuSolverTest, GivesTheSameBitsAtEveryWorkGroupSize) {
  for (const Scene& scene : {test::everythingScene(37), test::layeredSheets(37, SelfCollision::robust)}) {
    const std::uint64_t usual = stateHash(steppedOnGpu(scene, 80));
    for (const auto& [columns, rows] : {std::pair{1, 1}, {8, 8}, {256, 1}})
      EXPECT_EQ(stateHash(steppedOnGpu(scene, 80, {.groupColumns = columns, .groupRows = rows})), usual)
          << columns << "x" << rows;
  }
}

// As on hardware.
TEST_F(GpuSolverTest, GivesTheSameBitsFromStorageBlocksAsFromTexels) {
  const GpuOptions hardware{.groupColumns = 32, .groupRows = 8, .storageLoads = true};
  for (const Scene& scene : {test::everythingScene(33), test::layeredSheets(17, SelfCollision::robust),
                             test::implicitly(test::withColliders(test::materialScene(17))),
                             test::meshWithEverything(8, SelfCollision::averaged)})
    EXPECT_EQ(difference(steppedOnGpu(scene, 10, hardware), steppedOnCpu(scene, 10)).differing, 0u);
}

// As on hardware, with tiles that end within the grid.
TEST_F(GpuSolverTest, LimitsStrainInTilesAsPassByPass) {
  for (const auto& [name, scene] : test::fullestScenes(31)) {
    if (!scene.solver.strainLimit) continue;
    EXPECT_EQ(difference(steppedOnGpu(scene, 20, {.limitsInTiles = true}), steppedOnCpu(scene, 20)).differing,
              0u)
        << name;
  }
}

// On hardware the work groups of coarse levels are larger than here.
TEST_F(GpuSolverTest, GivesTheSameBitsInImplicitStepsHoweverTheyAreDispatched) {
  Scene scene = test::implicitly(test::withColliders(test::vertical(test::materialScene(26))));
  const std::uint64_t usual = stateHash(steppedOnGpu(scene, 2));
  for (const GpuOptions& options :
       {GpuOptions{.fused = false}, GpuOptions{.groupColumns = 16, .groupRows = 4},
        GpuOptions{.coarseLanes = 32}, GpuOptions{.coarseLanes = 1024}, GpuOptions{.coarsensInGroups = true},
        GpuOptions{.looksAtFlags = FlagLooks::whenReady}})
    EXPECT_EQ(stateHash(steppedOnGpu(scene, 2, options)), usual)
        << options.fused << ", " << options.groupColumns << "x" << options.groupRows << ", "
        << options.coarseLanes;
}

// The CPU does without where the cloth moves as a whole, which brings nothing nearer.
TEST_F(GpuSolverTest, BuildsTheHashAtLeastAsOftenAsTheCpu) {
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    const Scene scene = test::layeredSheets(24, mode);
    const Cloth cloth(scene);
    GpuSolver gpu(cloth, scene);
    CpuSolver<float> cpu(cloth, scene);
    gpu.step(300);
    cpu.step(300);
    EXPECT_GE(gpu.contactCounts().hashBuilds, cpu.contactCounts().hashBuilds);
    EXPECT_EQ(gpu.contactCounts().clampedSteps, cpu.contactCounts().clampedSteps);
    EXPECT_GT(cpu.contactCounts().hashBuilds, 1u);
    EXPECT_LT(gpu.contactCounts().hashBuilds, 150u);
  }
}

// A cloth at the end of a hard throw, in which the clamp has to step in.
TEST_F(GpuSolverTest, GuardsAsTheCpuDoes) {
  const Scene scene = test::layeredSheets(24, SelfCollision::robust);
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  State thrown = initialState(cloth, scene);
  for (std::size_t i = 576; i < 1152; ++i) thrown.velocities[i].y = i % 3 == 0 ? -80.0f : -75.0f;
  gpu.setState(thrown);
  cpu.setState(thrown);
  gpu.step(200);
  cpu.step(200);
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_GT(cpu.contactCounts().clampedSteps, 0u);
  EXPECT_EQ(gpu.contactCounts().clampedSteps, cpu.contactCounts().clampedSteps);
  for (Solver* solver : std::initializer_list<Solver*>{&gpu, &cpu}) {
    solver->forgetContactCounts();
    EXPECT_EQ(solver->contactCounts().clampedSteps, 0u);
    solver->step(20);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
}

TEST_F(GpuSolverTest, DoesNotDependOnHowStepsAreBatched) {
  const Scene scene = test::everythingScene(16);  // time-dependent: parameters are uploaded in batches
  const Cloth cloth(scene);
  GpuSolver whole(cloth, scene), pieces(cloth, scene);
  whole.step(300);
  for (const int count : {1, 62, 1, 64, 65, 107}) pieces.step(count);
  EXPECT_EQ(stateHash(whole.state()), stateHash(pieces.state()));
}

TEST_F(GpuSolverTest, HandsItsStateToTheCpuAndBackWithoutChangingABitOfWhatFollows) {
  for (const auto& [name, scene] : test::fullestScenes(20)) {
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
  const Scene scene = test::everythingScene(20);
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
    solver->step(50);
    solver->configure(windy);
    solver->step(50);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
  EXPECT_NE(stateHash(gpu.state()), stateHash(steppedOnGpu(scene, 140))) << "the edit did something";
}

// Motions are live: other pins, other paths, none; the numbers of paths lie in a buffer of their own.
TEST_F(GpuSolverTest, TakesEditsOfPinMotionsFromTheNextStepOn) {
  const Scene moving = test::withPinMotion(test::withWind(test::vertical(test::sheetScene(20))));
  Scene fewer = moving, none = moving;
  fewer.cloths[0].pinMotion.erase(fewer.cloths[0].pinMotion.begin());
  fewer.cloths[0].pinMotion[0].keys[1].rotation = {10, 20, 30};
  none.cloths[0].pinMotion.clear();
  const Cloth cloth(moving);
  GpuSolver gpu(cloth, none);
  CpuSolver<float> cpu(cloth, none);
  for (const Scene& scene : {moving, fewer, none, moving}) {
    for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
      solver->configure(scene);
      solver->step(50);
    }
    EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u) << scene.cloths[0].pinMotion.size();
  }
}

TEST_F(GpuSolverTest, SwitchesIntegratorsWithoutTouchingPinsInMotion) {
  const Scene scene = test::withPinMotion(test::vertical(test::sheetScene(20)));
  Scene other = scene;
  other.solver.integrator = Integrator::euler;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->step(100);
    solver->configure(other);
  }
  const State kicked = gpu.state();
  EXPECT_EQ(difference(kicked, cpu.state()).differing, 0u);
  const State still = steppedOnCpu(scene, 100);
  int moving = 0;
  for (std::size_t i = 0; i < still.positions.size(); ++i) {
    if (still.positions[i].w != 0) continue;
    EXPECT_EQ(kicked.velocities[i].x, still.velocities[i].x) << i;
    EXPECT_EQ(kicked.velocities[i].y, still.velocities[i].y) << i;
    EXPECT_EQ(kicked.velocities[i].z, still.velocities[i].z) << i;
    moving += kicked.velocities[i].x != 0;
  }
  EXPECT_GT(moving, 19);
}

TEST_F(GpuSolverTest, TimesItsPasses) {
  const Scene scene = test::withColliders(test::withLimiter(test::vertical(test::sheetScene(64))));
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene, {.fused = false});
  const std::vector<PassTime> times = solver.timePasses(3);
  std::vector<std::string> names;
  for (const PassTime& time : times) {
    names.push_back(time.name);
    EXPECT_GT(time.seconds, 0) << time.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"forces", "integrate", "collide", "limit", "watch limit"}));
  EXPECT_EQ(solver.stepIndex(), 3u);
}

}  // namespace
}  // namespace clothsim
