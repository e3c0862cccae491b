#include "viewer/pace_advice.h"

#include <gtest/gtest.h>

#include "scene_io/scene_io.h"
#include "viewer/pace.h"

namespace clothsim {
namespace {

TEST(PaceAdvice, IsSilentWhileThePaceIsHeld) {
  EXPECT_FALSE(adviceFor({1.0, 0.9, 0.9}, loadSceneByName("pinned2"), Quality::final, true, "cpu"));
}

TEST(PaceAdvice, NamesWhatTakesLongerAndOffersOneStepOfTheRemedy) {
  const Scene scene = loadSceneByName("pinned2");
  const auto drawing = adviceFor({0.5, 0.3, 0.7}, scene, Quality::final, true, "cpu");
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->cause, "Drawing takes 70 % of the time");
  EXPECT_EQ(drawing->quality, Quality::normal);
  EXPECT_FALSE(drawing->scene);
  EXPECT_FALSE(adviceFor({0.5, 0.3, 0.7}, scene, Quality::draft, true, "cpu"))
      << "there is nothing below draft";
  const auto detour = adviceFor({0.5, 0.7, 0.3}, scene, Quality::final, true, "gpu");
  ASSERT_TRUE(detour);
  EXPECT_EQ(detour->backend, "cpu");
}

TEST(PaceAdvice, OffersAGridThatWouldHoldThePace) {
  Scene scene = loadSceneByName("pinned2");
  static_cast<void>(changeResolution(scene, 96, 96, false));
  const auto advice = adviceFor({0.25, 0.95, 0.2}, scene, Quality::draft, true, "cpu");
  ASSERT_TRUE(advice && advice->scene);
  const ClothSettings& cloth = advice->scene->cloths[0];
  EXPECT_EQ(cloth.numWidthPoints, 40) << "a quarter of the particles, and a tenth less";
  EXPECT_EQ(cloth.numHeightPoints, 40);
  EXPECT_NE(advice->button.find("40"), std::string::npos);
}

TEST(PaceAdvice, OffersFewerStepsOnlyWhereTheyStayStable) {
  Scene scene = loadSceneByName("pinned2");
  static_cast<void>(changeResolution(scene, 16, 16, false));
  scene.solver.simulationSteps = 8;
  EXPECT_FALSE(adviceFor({0.2, 1, 0}, scene, Quality::draft, false, "gpu")) << "explicit steps would blow up";
  scene.solver.integrator = Integrator::implicit;
  const auto advice = adviceFor({0.2, 1, 0}, scene, Quality::draft, false, "gpu");
  ASSERT_TRUE(advice && advice->scene);
  EXPECT_EQ(advice->scene->solver.simulationSteps, 4);
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
