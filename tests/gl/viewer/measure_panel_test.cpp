#include "viewer/panels/measure_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "core/files.h"
#include "gl/viewer/small_scene.h"
#include "session/session.h"
#include "solver/state.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

// Steps that cannot be solved, on a sheet of n x n points.
Scene unsolvableSheet(int n) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = n;
  scene.cloths[0].pinned = {GridPoint{0, 0}};
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 20;
  scene.solver.simulationSteps = scene.solver.newtonSteps = 1;
  scene.solver.cgIterations = 1;
  return scene;
}

bool tellsOfConvergence(const MeasurePanel& panel, const Scene& scene) {
  const std::vector<Warning> warnings = panel.warnings(scene);
  return std::any_of(warnings.begin(), warnings.end(),
                     [](const Warning& warning) { return warning.kind == "convergence"; });
}

TEST(MeasurePanel, TellsOfUnsolvedStepsWhileThereAreAnyWhateverTheSizeOfTheCloth) {
  for (const int n : {12, 260}) {  // of the larger one no other samples are taken
    const Scene scene = unsolvableSheet(n);
    Session session(scene, "cpu", makeCpuSolver);
    MeasurePanel panel;
    const auto nothing = []() -> std::optional<std::uint32_t> { return std::nullopt; };
    panel.update(session, 0, nothing);
    EXPECT_FALSE(tellsOfConvergence(panel, scene)) << "nothing has been stepped";
    ASSERT_FALSE(session.stepFrames(3));
    panel.update(session, 0.01, nothing);
    EXPECT_FALSE(tellsOfConvergence(panel, scene)) << "it is too soon for the next sample";
    panel.update(session, 100, nothing);
    EXPECT_TRUE(tellsOfConvergence(panel, scene)) << n;
    Scene explicitly = scene;
    explicitly.solver.integrator = Integrator::verlet;
    EXPECT_FALSE(tellsOfConvergence(panel, explicitly));
    panel.forget(session);
    EXPECT_FALSE(tellsOfConvergence(panel, scene)) << "after a restart";
  }
}

TEST(MeasurePanel, SavesTheSamplesOfItsCurves) {
  const test::TemporaryFolder folder;
  Session session(test::smallScene(), "cpu", makeCpuSolver);
  MeasurePanel panel;
  const auto nothing = []() -> std::optional<std::uint32_t> { return std::nullopt; };
  for (int i = 0; i < 3; ++i) {
    panel.update(session, 100.0 * i, nothing);
    ASSERT_FALSE(session.stepFrames(2));
  }
  panel.saveCurves(folder / "curves.csv");
  std::istringstream lines(readFile(folder / "curves.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time,kinetic_energy,gravity_energy,spring_energy,max_strain,self_contacts");
  std::vector<double> times, kinetic;
  for (double time = 0, energy = 0; std::getline(lines, line);) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,", &time, &energy), 2) << line;
    times.push_back(time);
    kinetic.push_back(energy);
  }
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0], 0);
  EXPECT_NEAR(times[2], 4 / session.simulation().scene().solver.framesPerSec, 1e-6);
  EXPECT_EQ(kinetic[0], 0);
  EXPECT_GT(kinetic[2], kinetic[1]) << "it falls";
}

TEST(MeasurePanel, MeasuresTheClothOfAnotherSessionByItsOwnSprings) {
  const test::TemporaryFolder folder;
  Session large(loadSceneByName("pinned2"), "cpu", makeCpuSolver),
      small(test::smallScene(), "cpu", makeCpuSolver);
  const auto nothing = []() -> std::optional<std::uint32_t> { return std::nullopt; };
  MeasurePanel used, fresh;
  used.update(large, 0, nothing);
  used.forget(small);
  used.update(small, 1, nothing);
  fresh.update(small, 1, nothing);
  used.saveCurves(folder / "used.csv");
  fresh.saveCurves(folder / "fresh.csv");
  EXPECT_EQ(readFile(folder / "used.csv"), readFile(folder / "fresh.csv"));
}

TEST(MeasurePanel, TellsOfNothingThatHappenedInAFutureOrARunThatIsGone) {
  Scene scene = test::smallScene();
  scene.solver.selfCollision = SelfCollision::robust;
  Session session(scene, "cpu", makeCpuSolver);
  MeasurePanel panel;
  double now = 0;
  const auto tells = [&] {
    panel.update(session, now += 100, []() -> std::optional<std::uint32_t> { return std::nullopt; });
    return !panel.warnings(scene).empty();
  };
  const auto throwDown = [&] {  // farther in a step than the search for contacts reaches
    State state = session.simulation().state();
    for (Particle4& velocity : state.velocities) velocity.y = -200;
    session.simulation().setState(state);
    ASSERT_FALSE(session.stepFrames(1));
  };
  ASSERT_FALSE(session.stepFrames(2));
  ASSERT_FALSE(tells());
  throwDown();
  ASSERT_TRUE(tells());
  panel.keepCounts(session);
  session.seek(1);
  EXPECT_TRUE(tells()) << "only another frame is shown";
  panel.dropFuture(session);
  ASSERT_FALSE(session.stepFrames(2));
  EXPECT_FALSE(tells());
  throwDown();
  ASSERT_TRUE(tells());
  session.act(Restart{});
  panel.forget(session);
  ASSERT_FALSE(session.stepFrames(1));
  EXPECT_FALSE(tells());
}

}  // namespace
}  // namespace clothsim
