#include "viewer/pace.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

constexpr double frameSeconds = 1.0 / 90;  // CS184's frames_per_sec

// Simulated frames after `count` displayed frames of `elapsed` seconds each.
int framesAfter(Pace& pace, int count, double elapsed) {
  int frames = 0;
  for (int i = 0; i < count; ++i) frames += pace.framesDue(elapsed);
  return frames;
}

// Ten seconds of wall time are ten seconds of simulated time, to a frame.
TEST(Pace, RunsInRealTimeWhateverTheRateOfTheDisplay) {
  for (const int displayRate : {24, 30, 60, 90, 144, 1000}) {
    Pace pace(frameSeconds);
    framesAfter(pace, displayRate, 1.0 / displayRate);  // a second to settle in
    EXPECT_NEAR(framesAfter(pace, 10 * displayRate, 1.0 / displayRate), 900, 1) << displayRate << " Hz";
  }
}

TEST(Pace, NeverSimulatesMoreThanAFewFramesAtOnce) {
  Pace pace(frameSeconds);
  for (int i = 0; i < 100; ++i) EXPECT_LE(pace.framesDue(i % 7 == 0 ? 3.0 : 0.02), Pace::mostFramesAtOnce);
}

// A simulated frame costs 40 ms on this machine: asking for all that are due would take longer and longer.
TEST(Pace, DoesNotSpiralWhenAFrameCostsMoreThanItSimulates) {
  Pace pace(frameSeconds);
  double elapsed = 1.0 / 60;
  for (int i = 0; i < 50; ++i) {
    const int frames = pace.framesDue(elapsed);
    pace.simulated(frames, 0.040 * frames);
    elapsed = 0.005 + 0.040 * frames;
  }
  EXPECT_LE(elapsed, 0.046) << "the display crawls";
}

// Drawing takes 45 ms, simulating a frame 1 ms: a slow picture is no reason for slow cloth.
TEST(Pace, KeepsRealTimeWhenOnlyTheDrawingIsSlow) {
  Pace pace(frameSeconds);
  int frames = 0;
  double wall = 0;
  for (double elapsed = 0.045; wall < 10; wall += elapsed) {
    const int now = pace.framesDue(elapsed);
    pace.simulated(now, 0.001 * now);
    frames += now;
    elapsed = 0.045 + 0.001 * now;
  }
  EXPECT_NEAR(frames, wall / frameSeconds, 5);
}

// A picture takes 60 ms, and beside it, on cores that it wants as well, a frame takes 30 ms.
TEST(Pace, IsNotHeldBackByFramesThatTheDisplayDoesNotWaitFor) {
  Pace pace(1.0 / 60);
  int frames = 0;
  for (int picture = 0; picture < 100; ++picture) {
    const int now = pace.framesDue(0.06, false);
    pace.simulated(now, 0.03 * now);
    frames += now;
  }
  EXPECT_NEAR(frames, 6 * 60, 1);
}

TEST(Pace, ForgetsWhatItMissedInsteadOfRushingAfterAStop) {
  Pace pace(frameSeconds);
  framesAfter(pace, 60, 1.0 / 60);
  (void)pace.framesDue(30.0);  // the window was being dragged, say
  EXPECT_LE(framesAfter(pace, 60, 1.0 / 60), 91);
}

TEST(Pace, SaysWhenTheNextFrameIsDue) {
  Pace pace(0.1);
  EXPECT_EQ(pace.framesDue(0.03), 0);
  EXPECT_NEAR(pace.secondsUntilDue(), 0.07, 1e-12);
}

TEST(SpeedMeter, AveragesOverHalfASecond) {
  SpeedMeter meter;
  for (int i = 0; i < 29; ++i) meter.add(1.0 / 60, 0.4 / 60);
  EXPECT_EQ(meter.framesPerSecond(), 0) << "too early to tell";
  meter.add(1.0 / 60 + 1e-9, 0.4 / 60);
  EXPECT_NEAR(meter.framesPerSecond(), 60, 0.01);
  EXPECT_NEAR(meter.realTimeFactor(), 0.4, 1e-6);
}

}  // namespace
}  // namespace clothsim
