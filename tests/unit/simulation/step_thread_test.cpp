// Frames on a thread of their own are the frames of a session without one.
#include "session/step_thread.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/thread_team.h"
#include "scene_io/scene_io.h"
#include "solver/state.h"

namespace clothsim {
namespace {

using std::chrono::milliseconds;

Scene sheetScene() {
  Scene scene = loadSceneByName("pinned2");
  static_cast<void>(changeResolution(scene, 16, 16, false));
  return scene;
}

std::uint64_t hashOf(Session& session) { return stateHash(session.simulation().solver().state()); }

// What a user does, between frames.
template <class Step>
void actAndStep(Session& session, Step step) {
  step(3);
  session.act(Grab{.particle = 70, .target = {0.5, 1.2, 0.5}, .strength = 1e4, .radius = 0.2});
  step(2);
  Scene edited = session.simulation().scene();
  edited.gravity = {0, -5, 0};
  session.act(EditScene{edited});
  session.act(MoveHand{{0.4, 1.0, 0.4}});
  step(2);
  session.act(Release{});
  session.act(SwitchBackend{"cpu"});
  step(1);
  session.act(Restart{});
  step(2);
}

TEST(StepThread, SimulatesTheSameBitsAndTheSameRecordingAsWithoutIt) {
  Session plain(sheetScene(), "cpu", makeCpuSolver), threaded(sheetScene(), "cpu", makeCpuSolver);
  StepThread thread;
  threaded.setPoll([&] { return !thread.isStopped(); });
  actAndStep(plain, [&](int frames) { EXPECT_FALSE(plain.stepFrames(frames)); });
  actAndStep(threaded, [&](int frames) {
    thread.start(threaded, frames, 1e9);
    EXPECT_TRUE(thread.isBusy());
    const StepThread::Result result = thread.take();
    EXPECT_EQ(result.frames, frames);
    EXPECT_FALSE(result.divergence);
    EXPECT_FALSE(result.error);
  });
  EXPECT_EQ(hashOf(threaded), hashOf(plain));
  EXPECT_EQ(threaded.recording().format(), plain.recording().format());
}

// Waves of two threads and of one follow each other, and what began on two goes on with one.
TEST(StepThread, SimulatesTheSameBitsWhilePicturesTakeTheCores) {
  Scene scene = loadSceneByName("demo");
  static_cast<void>(changeResolution(scene, 64, 64, false));
  Session plain(scene, "cpu", makeCpuSolver), threaded(scene, "cpu", makeCpuSolver);
  EXPECT_FALSE(plain.stepFrames(12));
  StepThread thread;
  thread.start(threaded, 12, 1e9);
  while (!thread.isDone()) {
    const WorkAlone whileDrawing(ThreadTeam::shared());
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  EXPECT_EQ(thread.take().frames, 12);
  EXPECT_EQ(hashOf(threaded), hashOf(plain));
}

TEST(StepThread, EndsWithinALongFrameAndLeavesTheOneBefore) {
  Scene scene = sheetScene();
  scene.solver.simulationSteps = 10'000'000;
  Session session(scene, "cpu", makeCpuSolver);
  const std::uint64_t before = hashOf(session);
  StepThread thread;
  session.setPoll([&] { return !thread.isStopped(); });
  thread.start(session, 1, 1e9);
  EXPECT_FALSE(thread.waitFor(milliseconds(100))) << "the frame takes minutes";
  thread.stop();
  EXPECT_TRUE(thread.waitFor(milliseconds(5000)));
  EXPECT_EQ(thread.take().frames, 0);
  EXPECT_EQ(hashOf(session), before);
}

TEST(StepThread, StopsAfterTheFrameThatUsedUpItsTime) {
  Session session(sheetScene(), "cpu", makeCpuSolver);
  StepThread thread;
  thread.start(session, 1000, 0);
  EXPECT_EQ(thread.take().frames, 0) << "no time, no frame";
  thread.start(session, 1000, 1e-9);
  EXPECT_EQ(thread.take().frames, 1);
}

TEST(StepThread, HandsOverDivergenceAndCallsWhenDone) {
  Scene scene = sheetScene();
  scene.solver.maxSpeed = 1e-3;
  std::atomic<int> calls{0};
  StepThread thread([&] { ++calls; });
  Session session(scene, "cpu", makeCpuSolver);
  thread.start(session, 100, 1e9);
  const StepThread::Result result = thread.take();
  EXPECT_TRUE(result.divergence);
  EXPECT_LT(result.frames, 100);
  for (int i = 0; i < 1000 && calls == 0; ++i) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace clothsim
