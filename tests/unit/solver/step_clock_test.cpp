// Time does not move when the step length changes: not on the clock, and not for what follows a path or blows
// in gusts.
#include <gtest/gtest.h>

#include "measure/measure.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/cpu_solver.h"

namespace clothsim {
namespace {

TEST(StepClock, CountsWholeStepsAndSoDoesNotDrift) {
  StepClock clock;
  clock.setStepLength(0.1);
  for (int i = 0; i < 1'000'000; ++i) ++clock.step;
  EXPECT_EQ(clock.time(), 1e6 * 0.1);
  EXPECT_EQ(clock.timeAfter(2), 1'000'002 * 0.1);
}

TEST(StepClock, KeepsItsTimeWhenTheStepLengthChanges) {
  StepClock clock;
  clock.setStepLength(0.001);
  clock.step = 1500;
  clock.setStepLength(0.1);
  EXPECT_EQ(clock.time(), 1.5);
  clock.step += 5;
  EXPECT_DOUBLE_EQ(clock.time(), 2);
  clock.setStepLength(0.1);
  EXPECT_EQ(clock.originStep, 1500u) << "nothing has changed";
}

TEST(StepClock, OfAnOldStateFileTakesTheStepLengthOfTheScene) {
  StepClock clock{300, 0, 0, 0};
  clock.setStepLength(0.01);
  EXPECT_EQ(clock.time(), 3);
}

// A sheet whose pinned edge is carried along at 1 m/s, over a ball that goes with it.
Scene carriedSheet(int stepsPerFrame, const char* integrator = "verlet") {
  return parseScene(
      R"({"cloth": {"width": 1, "height": 1, "num_width_points": 5, "num_height_points": 5, "ks": 200,
      "pinned": ["top"], "pin_motion": {"keys": [{"t": 0, "position": [0.5, 1, 0]}, {"t": 9, "position": [9.5, 1, 0]}]}},
    "colliders": [{"type": "sphere", "origin": [0.5, 0.2, 0.5],
      "motion": {"keys": [{"t": 0, "position": [0.5, 0.2, 0.5]}, {"t": 9, "position": [9.5, 0.2, 0.5]}]}}],
    "solver": {"frames_per_sec": 10, "self_collision": false, "simulation_steps": )" +
          std::to_string(stepsPerFrame) + R"(, "integrator": ")" + integrator + "\"}}",
      "carried");
}

class ChangedStep : public testing::TestWithParam<const char*> {};

TEST_P(ChangedStep, LeavesPinsAndCollidersWhereTheyAre) {
  const Scene before = carriedSheet(20), after = carriedSheet(7, GetParam());
  const Cloth cloth(before);
  CpuSolver<float> live(cloth, before);
  live.step(400);
  const State state = live.state();
  EXPECT_NEAR(state.positions[0].x, 2, 1e-5) << "2 s at 1 m/s";

  live.configure(after);
  CpuSolver<float> fresh(cloth, after);
  fresh.setState(state);
  for (CpuSolver<float>* solver : {&live, &fresh}) {
    EXPECT_DOUBLE_EQ(solver->clock().time(), 2);
    solver->step(7);
    EXPECT_DOUBLE_EQ(solver->clock().time(), 2.1);
    EXPECT_NEAR(solver->state().positions[0].x, 2.1, 1e-5);
  }
  EXPECT_EQ(stateHash(live.state()), stateHash(fresh.state()));
  EXPECT_EQ(measure(cloth, after, live.state()).maxPenetration,
            measure(cloth, after, fresh.state()).maxPenetration);
  EXPECT_LT(measure(cloth, after, live.state()).maxStrain, 1) << "nothing was torn along";
}
INSTANTIATE_TEST_SUITE_P(Integrators, ChangedStep, testing::Values("verlet", "euler", "implicit", "bdf2"));

TEST(ChangedStep, LeavesGustsAsTheyBlow) {
  Scene scene = carriedSheet(20);
  scene.wind = Wind{{1, 0, 0}, {3, 0.5, 4}};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(400);
  Scene finer = scene;
  finer.solver.simulationSteps = 40;
  solver.configure(finer);
  // A twin that reached the same time in the finer steps feels the same wind: it exerts the same forces on
  // the same state.
  CpuSolver<float> twin(cloth, finer);
  State state = solver.state();
  state.clock = {800, 1 / 400.0, 0, 0};
  twin.setState(state);
  EXPECT_EQ(solver.forces(), twin.forces());
}

TEST(ChangedStep, IsUndoneByASnapshotFromBefore) {
  const Scene before = carriedSheet(20), after = carriedSheet(7);
  const Cloth cloth(before);
  CpuSolver<float> solver(cloth, before), undisturbed(cloth, before);
  solver.step(40);
  undisturbed.step(80);
  const auto snapshot = solver.snapshot(nullptr);
  solver.configure(after);
  solver.step(10);
  solver.configure(before);
  solver.restore(*snapshot);
  solver.step(40);
  EXPECT_EQ(stateHash(solver.state()), stateHash(undisturbed.state()));
  EXPECT_EQ(solver.clock(), undisturbed.clock());
}

}  // namespace
}  // namespace clothsim
