// Hands on the cloth: the GPU and the CPU agree in every bit of what they do, in every combination of passes.
#include <gtest/gtest.h>

#include <memory>

#include "gl/gl_test.h"
#include "simulation/compare.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/gpu/gpu_solver.h"
#include "support/compared_scenes.h"
#include "support/grabs.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using InteractionOnGpuTest = GlTest;

// Grabs with neighbours, moves, cuts, blows, pins and lets go, some steps each.
void playWith(Solver& solver, const Cloth& cloth, const Scene& scene) {
  const Piece& piece = cloth.pieces()[0];
  const std::uint32_t middle = piece.particle(piece.columns / 2, piece.rows / 2);
  solver.step(20);
  Interaction interaction = test::grabTo(solver, cloth, scene, middle, {0.6, 0.7, 0.5}, 1e5, 0.25);
  solver.setInteraction(interaction);
  solver.step(70);  // more than a batch
  solver.setCuts(test::someCuts(cloth));
  solver.step(20);
  interaction.jet = Jet{{0.3, 0.4, -1}, {0.1, 0.2, 1}, 8, 0.4};
  solver.setInteraction(interaction);
  solver.setPin(piece.particle(1, 1), true);
  solver.step(40);
  solver.setPin(piece.particle(1, 1), false);
  moveTo(*interaction.grab, {0.2, 0.9, -0.3}, solver.stepIndex(), 30);
  solver.setInteraction(interaction);
  solver.setCuts(test::cutAcross(cloth, piece.rows / 2 - 0.5));
  solver.step(40);
  solver.setInteraction({});
  solver.step(30);
}

template <class SolverType, class... Options>
State playedOn(const Scene& scene, const Options&... options) {
  const Cloth cloth(scene);
  SolverType solver(cloth, scene, options...);
  playWith(solver, cloth, scene);
  EXPECT_EQ(solver.divergence(), std::nullopt);
  return solver.state();
}

Scene everything() {
  return test::withPinMotion(
      test::withWind(test::withColliders(test::withLimiter(test::vertical(test::sheetScene(17))))));
}
Scene layers() { return test::layeredSheets(14, SelfCollision::robust); }

TEST_F(InteractionOnGpuTest, DoesWhatItDoesOnTheCpuToTheBit) {
  for (const auto& [name, scene] :
       {test::NamedScene{"everything", everything()}, test::NamedScene{"robust self-collision", layers()},
        test::NamedScene{"thick averaged self-collision",
                         test::thick(test::layeredSheets(8, SelfCollision::averaged))},
        test::NamedScene{"two cloths", test::twoCloths(test::vertical(test::sheetScene(17)))},
        test::NamedScene{"material", test::materialScene(17)},
        test::NamedScene{"implicit", test::implicitly(test::vertical(test::sheetScene(17)))}}) {
    const State gpu = playedOn<GpuSolver>(scene), cpu = playedOn<CpuSolver<float>>(scene);
    const StateDifference result = difference(gpu, cpu);
    EXPECT_EQ(result.differing, 0u) << name << ", by at most " << result.maxAbs;
    EXPECT_TRUE(result.finite) << name;
    EXPECT_EQ(gpu.cuts, cpu.cuts);
    EXPECT_EQ(gpu.offPath, cpu.offPath);
  }
}

TEST_F(InteractionOnGpuTest, GivesTheSameBitsFusedAndPassByPass) {
  for (const Scene& scene : {everything(), layers()}) {
    const std::uint64_t fused = stateHash(playedOn<CpuSolver<float>>(scene));
    EXPECT_EQ(stateHash(playedOn<CpuSolver<float>>(scene, false)), fused);
    EXPECT_EQ(
        stateHash(playedOn<GpuSolver>(scene, GpuOptions{.fused = false, .groupColumns = 16, .groupRows = 4})),
        fused);
    EXPECT_EQ(stateHash(playedOn<GpuSolver>(scene, GpuOptions{.limitsInTiles = true})), fused);
  }
}

TEST_F(InteractionOnGpuTest, IsStableAtAnyStrengthOnBothBackends) {
  for (const double strength : {1e-12, 1e12, 1e300}) {
    for (const int steps : {1, 30}) {
      Scene scene = test::vertical(test::sheetScene(9));
      scene.solver.simulationSteps = steps;
      if (steps == 1) scene.cloths[0].ks = 50;
      const Cloth cloth(scene);
      GpuSolver gpu(cloth, scene);
      CpuSolver<float> cpu(cloth, scene);
      for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
        solver->setInteraction(test::grabTo(*solver, cloth, scene, 4, {0.7, 0.2, 0.5}, strength, 0.2));
        solver->step(10 * steps);
        EXPECT_EQ(solver->divergence(), std::nullopt) << strength;
      }
      const StateDifference result = difference(gpu.state(), cpu.state());
      EXPECT_EQ(result.differing, 0u) << strength << ", " << steps;
      EXPECT_TRUE(result.finite) << strength << ", " << steps;
    }
  }
}

// The air of a jet counts when velocities change their meaning.
TEST_F(InteractionOnGpuTest, CountsTheJetWhenTheIntegratorChanges) {
  Scene scene = test::vertical(test::sheetScene(12)), other = scene;
  other.solver.integrator = Integrator::euler;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  Interaction interaction;
  interaction.jet = Jet{{0.5, 0.5, -1}, {0, 0, 1}, 10, 0.5};
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->setInteraction(interaction);
    solver->step(30);
    solver->configure(other);
    solver->setCuts(test::someCuts(cloth));
    solver->convertVelocities();
    solver->step(30);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
}

TEST_F(InteractionOnGpuTest, LetsCrumbsFallAsTheCpuDoes) {
  const Scene scene = test::implicitly(test::vertical(test::sheetScene(17)));
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->setCuts(test::crumbled(cloth));
    solver->step(5);
  }
  EXPECT_EQ(difference(gpu.state(), cpu.state()).differing, 0u);
}

TEST_F(InteractionOnGpuTest, GoesBackToSnapshotsOfEitherBackend) {
  const Scene scene = test::withPinMotion(test::withWind(test::vertical(test::sheetScene(17))));
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  gpu.step(40);
  gpu.setCuts(test::someCuts(cloth));
  gpu.setPin(5, true);
  gpu.step(10);
  std::unique_ptr<Snapshot> snapshot = gpu.snapshot(nullptr);
  EXPECT_EQ(snapshot->bytes(), 32u * 17 * 17) << "two vec4 a particle, and nothing is read back";
  gpu.setCuts({});
  gpu.step(50);
  gpu.restore(*snapshot);
  cpu.restore(*snapshot);
  std::unique_ptr<Snapshot> onCpu = cpu.snapshot(nullptr);
  gpu.step(50);
  cpu.step(50);
  const State after = cpu.state();
  EXPECT_EQ(difference(gpu.state(), after).differing, 0u);
  EXPECT_EQ(gpu.state().cuts, after.cuts);
  gpu.restore(*onCpu);
  gpu.step(50);
  EXPECT_EQ(difference(gpu.state(), after).differing, 0u);
}

// What friction remembers is a part of them.
TEST_F(InteractionOnGpuTest, GoesOnInSecondOrderFromStatesAndSnapshots) {
  const Scene scene = test::inSecondOrder(test::vertical(test::materialScene(9)));
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  gpu.step(8);
  const State state = gpu.state();
  EXPECT_EQ(state.histories.size(), 2 * cloth.particleCount());
  const std::unique_ptr<Snapshot> snapshot = gpu.snapshot(nullptr);
  const auto later = [](Solver& solver) {
    solver.step(3);
    return stateHash(solver.state());
  };
  const std::uint64_t expected = later(gpu);
  EXPECT_GT(gpu.convergenceCounts().secondOrderSteps, 5u);
  gpu.restore(*snapshot);
  EXPECT_EQ(later(gpu), expected);
  cpu.restore(*snapshot);
  const std::unique_ptr<Snapshot> onCpu = cpu.snapshot(nullptr);
  EXPECT_EQ(later(cpu), expected);
  cpu.setState(state);
  EXPECT_EQ(later(cpu), expected);
  gpu.restore(*onCpu);
  EXPECT_EQ(later(gpu), expected);
  State moved = state;
  forgetHistory(moved);
  gpu.setState(moved);
  EXPECT_NE(later(gpu), expected);
  // One that has not stepped yet goes on as well, whatever the other's last steps were.
  gpu.setState(moved);
  gpu.step(1);
  GpuSolver fresh(cloth, scene);
  fresh.setState(state);
  EXPECT_EQ(later(fresh), expected);
}

TEST_F(InteractionOnGpuTest, GoesBackToSnapshotsOfClothThatSticks) {
  Scene scene = test::materialSheet(9, 9, 0.5, 0.5, *materialPreset("cotton"));
  scene.solver.integrator = Integrator::implicit;
  scene.solver.simulationSteps = 2;
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  scene.solver.selfCollision = SelfCollision::contact;
  scene.colliders = {Sphere{.origin = {0.25, 0.49, 0.25}, .radius = 0.5, .friction = 0.5}};
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].position.y += 0.002;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  gpu.step(20);
  const std::unique_ptr<Snapshot> snapshot = gpu.snapshot(nullptr);
  EXPECT_EQ(snapshot->state().elasticSlips.size(), cloth.particleCount());
  EXPECT_FALSE(snapshot->state().pairSlips.empty());
  // It is known how many pairs there are, and a snapshot has room for no more.
  EXPECT_LT(snapshot->bytes(), 8 * cloth.particleCount() * 12 * sizeof(float));
  gpu.step(2);
  const std::uint64_t expected = stateHash(gpu.state());
  const auto later = [&](Solver& solver, const Snapshot& from) {
    solver.restore(from);
    solver.step(2);
    return stateHash(solver.state());
  };
  EXPECT_EQ(later(gpu, *snapshot), expected);
  EXPECT_EQ(later(cpu, *snapshot), expected);
  cpu.restore(*snapshot);
  EXPECT_EQ(later(gpu, *cpu.snapshot(nullptr)), expected);
  // What was counted before a snapshot came back says nothing about it.
  State apart = initialState(cloth, scene);
  for (std::size_t i = 81; i < apart.positions.size(); ++i) apart.positions[i].y += 1;
  gpu.setState(apart);
  gpu.step(1);
  EXPECT_FALSE(gpu.divergence().has_value());
  gpu.restore(*snapshot);
  EXPECT_FALSE(gpu.divergence().has_value());
  const std::unique_ptr<Snapshot> again = gpu.snapshot(nullptr);
  gpu.setState(apart);
  gpu.step(1);
  EXPECT_EQ(later(gpu, *again), expected);
}

// A cut and an edit begin with a new hash, and forget nothing that a run has to tell.
TEST_F(InteractionOnGpuTest, CountsContactsOverCutsAsTheCpuDoes) {
  Scene scene = test::layeredSheets(10, SelfCollision::robust);
  scene.solver.simulationSteps = 5;
  const Cloth cloth(scene);
  GpuSolver gpu(cloth, scene);
  CpuSolver<float> cpu(cloth, scene);
  for (Solver* solver : {static_cast<Solver*>(&gpu), static_cast<Solver*>(&cpu)}) {
    solver->setInteraction(test::grabTo(*solver, cloth, scene, 155, {0.5, -3, 0.5}, 1e9));
    solver->step(15);
    solver->setCuts(test::someCuts(cloth));
    solver->configure(scene);
    solver->step(20);
  }
  EXPECT_GT(cpu.contactCounts().fastSteps, 0u);
  EXPECT_EQ(gpu.contactCounts().fastSteps, cpu.contactCounts().fastSteps);
  EXPECT_GE(gpu.contactCounts().hashBuilds, cpu.contactCounts().hashBuilds);
}

// A snapshot's buffers are its own, also when the solver is gone.
TEST_F(InteractionOnGpuTest, ReusesTheMemoryOfASnapshotThatIsNeededNoMore) {
  const Scene scene = test::vertical(test::sheetScene(8));
  const Cloth cloth(scene);
  std::unique_ptr<Snapshot> snapshot;
  std::uint64_t hash = 0;
  {
    GpuSolver gpu(cloth, scene);
    snapshot = gpu.snapshot(nullptr);
    const Snapshot* memory = snapshot.get();
    gpu.step(30);
    snapshot = gpu.snapshot(std::move(snapshot));
    EXPECT_EQ(snapshot.get(), memory);
    hash = stateHash(gpu.state());
  }
  EXPECT_EQ(stateHash(snapshot->state()), hash);
}

}  // namespace
}  // namespace clothsim
