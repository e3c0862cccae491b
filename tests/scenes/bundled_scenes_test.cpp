// Every bundled scene keeps the promises of its `expect` block on the CPU. The GPU, which is a slow one here,
// takes over the state again and again, goes a frame of the way with it, or two implicit steps, and agrees in
// every bit; tools/compare_scenes goes the whole way.
#include <gtest/gtest.h>

#include <algorithm>

#include "gl/gl_test.h"
#include "measure/crossings.h"
#include "measure/measure.h"
#include "scene_io/scene_io.h"
#include "simulation/compare.h"
#include "simulation/gpu/solvers.h"
#include "solver/cpu/synchronized.h"

namespace clothsim {
namespace {

constexpr int EVERY = 30;  // frames

class BundledSceneTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { testContext(); }
  void TearDown() override { EXPECT_NO_THROW(gl::checkErrors("the end of the test")); }
};

void expectWithin(double value, const std::optional<Range>& range, const char* what) {
  if (!range) return;
  EXPECT_GE(value, range->low) << what;
  EXPECT_LE(value, range->high) << what;
}

TEST_P(BundledSceneTest, KeepsItsPromisesAndAgreesOnBothBackends) {
  const Scene scene = loadSceneByName(GetParam());
  ASSERT_TRUE(scene.expect.has_value()) << "a bundled scene says what to expect of it";
  const Expect& expect = *scene.expect;
  Simulation cpu(scene, "cpu", makeSolver), gpu(scene, "gpu", makeSolver);
  double maxPenetration = 0;
  State state;
  std::optional<CrossingCounter> counter;
  if (expect.crossings && CrossingCounter::available()) counter.emplace(cpu.sharedCloth());
  CrossingSummary crossings;
  const int steps = scene.solver.simulationSteps,
            together = isImplicit(scene.solver.integrator) ? std::min(2, steps) : steps;
  for (int frame = 0; frame < expect.frames; ++frame) {
    const bool goesAlong = frame % EVERY == EVERY - 1 || frame + 1 == expect.frames;
    if (goesAlong) {
      gpu.setState(cpu.state());
      for (Simulation* simulation : {&cpu, &gpu}) simulation->step(together);
      EXPECT_EQ(difference(cpu.state(), gpu.state()).differing, 0u) << "in frame " << frame;
    }
    cpu.step(goesAlong ? steps - together : steps);
    state = cpu.state();
    maxPenetration = std::max(maxPenetration, measure(cpu.cloth(), scene, state).maxPenetration);
    // Counting is dear, and what crosses stays so for some frames.
    if (counter && (frame % 5 == 4 || frame + 1 == expect.frames))
      crossings.add(frame, counter->count(state));
  }

  const Measures atEnd = measure(cpu.cloth(), scene, state);
  ASSERT_FALSE(atEnd.firstNonFinite.has_value());
  expectWithin(atEnd.minY, expect.minY, "min_y");
  expectWithin(atEnd.maxStrain, expect.maxStrain, "max_strain");
  expectWithin(measure(cpu.cloth(), scene, synchronized(cpu.cloth(), scene, state)).kineticEnergy,
               expect.kineticEnergy, "kinetic_energy");
  const bool isToRest = expect.kineticEnergy && expect.kineticEnergy->low == 0;
  if (isToRest && isImplicit(scene.solver.integrator)) {
    EXPECT_LT(cpu.convergenceCounts().lastUpdate, 1e-3) << "low energy alone is no rest (docs/physics.md)";
  }
  if (counter) expectWithin(static_cast<double>(crossings.worst), expect.crossings, "crossings");
  expectWithin(maxPenetration, expect.maxPenetration, "max_penetration");
  if (expect.centroid) {
    EXPECT_NEAR(atEnd.centroid.x, expect.centroid->x, expect.centroidTolerance);
    EXPECT_NEAR(atEnd.centroid.y, expect.centroid->y, expect.centroidTolerance);
    EXPECT_NEAR(atEnd.centroid.z, expect.centroid->z, expect.centroidTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BundledSceneTest, testing::ValuesIn(bundledNames()),
                         [](const auto& instance) { return instance.param; });

TEST(BundledScenes, HaveTheNamesThatTheAssignmentsKnow) {
  const std::vector<std::string> names = bundledNames();
  for (const char* name : {"pinned2", "pinned4", "plane", "sphere", "selfCollision", "cs171", "demo"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

}  // namespace
}  // namespace clothsim
