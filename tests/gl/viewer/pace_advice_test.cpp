#include "viewer/pace_advice.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "scene_io/scene_io.h"
#include "session/session.h"
#include "viewer/pace.h"
#include "viewer/pace_trials.h"

namespace clothsim {
namespace {

std::vector<PaceRemedy> remedies(const PaceFigures& figures, const Scene& scene,
                                 Quality quality = Quality::draft) {
  return remediesFor(figures, scene, quality, true, "cpu");
}
Scene sheetOf(int side) {
  Scene scene = loadSceneByName("pinned2");
  static_cast<void>(changeResolution(scene, side, side, false));
  return scene;
}
// The side of the square grid that is offered; 0 where there is none.
int sideOffered(double pace, int side) {
  for (const PaceRemedy& remedy : remedies({pace, 0.95, 0.2}, sheetOf(side)))
    if (remedy.scene && !isImplicit(remedy.scene->solver.integrator))
      return remedy.scene->cloths[0].numWidthPoints;
  return 0;
}

TEST(PaceAdvice, IsSilentWhileThePaceIsHeld) {
  EXPECT_FALSE(isSlow({1.0, 0.9, 0.9}));
  EXPECT_TRUE(remedies({1.0, 0.9, 0.9}, loadSceneByName("pinned2"), Quality::final).empty());
}

TEST(PaceAdvice, NamesWhatTakesLongerAndTriesOneStepOfTheRemedy) {
  const Scene scene = loadSceneByName("pinned2");
  EXPECT_EQ(causeOf({0.5, 0.3, 0.7}), "Drawing takes 70 % of the time");
  EXPECT_EQ(causeOf({0.5, 0.8, 0.7}), "Stepping takes 80 % of the time");
  const auto drawing = remedies({0.5, 0.3, 0.7}, scene, Quality::final);
  ASSERT_FALSE(drawing.empty());
  EXPECT_EQ(drawing[0].quality, Quality::normal);
  for (const PaceRemedy& remedy : remedies({0.5, 0.3, 0.7}, scene))
    EXPECT_FALSE(remedy.quality || remedy.scene) << "there is nothing below draft";
  const auto detour = remediesFor({0.5, 0.7, 0.3}, scene, Quality::final, true, "gpu");
  ASSERT_FALSE(detour.empty());
  EXPECT_EQ(detour[0].backend, "cpu");
}

TEST(PaceAdvice, OffersAGridThatStaysWhatItIs) {
  EXPECT_EQ(sideOffered(0.5, 96), 72) << "half of the particles, and a tenth less: 64.4, in steps of 8";
  EXPECT_EQ(sideOffered(0.01, 96), 56) << "a third of the particles";
  EXPECT_EQ(sideOffered(0.01, 50), 33);
  EXPECT_EQ(sideOffered(0.01, 33), 0);
  EXPECT_EQ(sideOffered(0.01, 16), 0);
  for (const int side : {40, 64, 100, 129})
    EXPECT_GE(3 * sideOffered(0.02, side) * sideOffered(0.02, side), side * side);
}

TEST(PaceAdvice, OffersFewerStepsOnlyWhereTheyStayStable) {
  Scene scene = sheetOf(33);
  scene.solver.simulationSteps = 8;
  for (const PaceRemedy& remedy : remedies({0.2, 1, 0}, scene))
    EXPECT_TRUE(!remedy.scene || isImplicit(remedy.scene->solver.integrator)) << "it would blow up";
  scene.solver.integrator = Integrator::implicit;
  const auto offered = remedies({0.4, 1, 0}, scene);
  ASSERT_TRUE(!offered.empty() && offered[0].scene);
  EXPECT_EQ(offered[0].scene->solver.simulationSteps, 2);
  EXPECT_EQ(offered[0].name, "2 steps a frame");
}

TEST(PaceAdvice, KeepsWhatTrialsHaveShownToHelp) {
  const PaceFigures figures{0.3, 1, 0};
  const PaceRemedy none{.name = "none", .pace = 0.31}, half{.name = "half", .pace = 0.6},
      whole{.name = "whole", .pace = 1.4}, slow{.name = "slow", .tempo = 0.25, .pace = 0.25};
  const auto namesOf = [&](std::vector<PaceRemedy> tried) {
    std::string names;
    for (const PaceRemedy& remedy : bestOf(std::move(tried), figures)) names += remedy.name + " ";
    return names;
  };
  EXPECT_EQ(namesOf({none, slow}), "slow ");
  EXPECT_EQ(namesOf({half, none, whole, slow}), "whole half slow ");
  EXPECT_EQ(namesOf({half, whole, half, whole, slow}), "whole whole slow ");
  const auto slowest = remedies({0.27, 1, 0}, sheetOf(16));
  ASSERT_FALSE(slowest.empty());
  EXPECT_EQ(slowest.back().tempo, 0.25);
}

TEST(PaceTrials, ContinueTheClothOnACoarserGridWhereItIs) {
  const Scene fine = sheetOf(31), coarse = sheetOf(11);
  const Cloth from(fine), to(coarse);
  Session session(fine, "cpu", makeCpuSolver);
  State state = session.simulation().state();
  for (Particle4& x : state.positions) x = {2 * x.x + x.z, x.y - 3 * x.z, x.z, x.w};  // linear: kept exactly
  for (std::size_t i = 0; i < state.velocities.size(); ++i)
    state.velocities[i] = {state.positions[i].z, 1, -state.positions[i].x, 0};
  const State sampled = resampled(state, from, to);
  ASSERT_EQ(sampled.positions.size(), to.particleCount());
  for (std::size_t i = 0; i < sampled.positions.size(); ++i) {
    const Vec3d p = to.positions()[i];
    EXPECT_LT(length(vectorOf(sampled.positions[i]) - Vec3d{2 * p.x + p.z, p.y - 3 * p.z, p.z}), 1e-5);
    if (sampled.positions[i].w == 0) continue;
    EXPECT_LT(length(vectorOf(sampled.velocities[i]) - Vec3d{p.z, 1, -(2 * p.x + p.z)}), 1e-5);
  }
}

TEST(PaceTrials, MeasureEachRemedyOnTheCpu) {
  const Scene scene = sheetOf(40);
  Session session(scene, "cpu", makeCpuSolver);
  PaceTrials trials;
  trials.start(remedies({0.05, 1, 0}, scene), scene, session.simulation().sharedCloth(),
               session.simulation().state(), 1e9);
  for (int i = 0; i < 600 && !trials.isDone(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(trials.isDone());
  const std::vector<PaceRemedy> tried = trials.take();
  ASSERT_FALSE(tried.empty());
  EXPECT_EQ(tried[0].scene->cloths[0].numWidthPoints, 33);
  EXPECT_GT(tried[0].pace.value_or(0), 0);
  EXPECT_FALSE(trials.isRunning());
}

TEST(SlowMotion, GoesDownToATenthAndBack) {
  double tempo = 1;
  for (const double expected : {0.5, 0.25, 0.1, 1.0}) EXPECT_EQ(tempo = nextTempo(tempo), expected);
}

TEST(SpeedMeter, TellsWhatTheTimeWentInto) {
  SpeedMeter meter;
  for (int i = 0; i < 60; ++i) {
    meter.spent(0.008, 0.002);
    meter.add(0.01, 0.005);
  }
  EXPECT_NEAR(meter.steppingShare(), 0.8, 1e-6);
  EXPECT_NEAR(meter.drawingShare(), 0.2, 1e-6);
  EXPECT_NEAR(meter.realTimeFactor(), 0.5, 1e-6);
}

}  // namespace
}  // namespace clothsim
