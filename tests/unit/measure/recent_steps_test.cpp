#include "measure/recent_steps.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

ConvergenceCounts countsOf(std::uint64_t steps, std::uint64_t unconverged, double lastUpdate) {
  return {.steps = steps, .unconvergedSteps = unconverged, .iterations = 3 * steps, .lastUpdate = lastUpdate};
}

TEST(RecentSteps, AreThoseOfTheLastSecond) {
  RecentSteps steps;
  // 90 steps a second and four samples; the first second goes wrong.
  for (int quarter = 0; quarter <= 4; ++quarter)
    steps.add(0.25 * quarter, countsOf(90 * quarter / 4, 10 * quarter, 0.01));
  EXPECT_EQ(steps.recent().steps, 90u);
  EXPECT_EQ(steps.recent().unconvergedSteps, 40u);
  EXPECT_EQ(steps.recent().iterations, 270u);
  EXPECT_EQ(steps.largestUpdate(), 0.01);
  for (int quarter = 5; quarter <= 8; ++quarter)
    steps.add(0.25 * quarter, countsOf(90 * quarter / 4, 40, 1e-4));
  EXPECT_EQ(steps.recent().unconvergedSteps, 0u) << "all is well again";
  EXPECT_EQ(steps.largestUpdate(), 1e-4);
  EXPECT_EQ(steps.all().unconvergedSteps, 40u) << "but was not always";
}

TEST(RecentSteps, OfSamplesFarApartAreThoseBetweenTheLastTwo) {
  RecentSteps steps;
  for (int sample = 0; sample < 3; ++sample)
    steps.add(5.0 * sample, countsOf(450 * sample, 7 * sample, 0.01));
  EXPECT_EQ(steps.recent().steps, 450u);
  EXPECT_EQ(steps.recent().unconvergedSteps, 7u);
}

TEST(RecentSteps, BeginAnewWhenTimeGoesBack) {
  RecentSteps steps;
  EXPECT_EQ(steps.all().steps, 0u);
  steps.add(1, countsOf(90, 9, 0.01));
  steps.add(1.5, countsOf(135, 20, 0.01));
  steps.add(0, countsOf(135, 20, 0.01));  // a restart
  EXPECT_EQ(steps.recent().steps, 0u);
  steps.add(0, countsOf(135, 20, 0.01));  // a paused viewer goes on looking
  steps.add(0.5, countsOf(180, 21, 0.02));
  EXPECT_EQ(steps.recent().steps, 45u);
  EXPECT_EQ(steps.recent().unconvergedSteps, 1u);
}

}  // namespace
}  // namespace clothsim
