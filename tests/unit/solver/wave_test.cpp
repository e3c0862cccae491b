// Passes that go down the rows together, each behind what it needs.
#include "solver/cpu/wave.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/thread_team.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/state.h"
#include "support/compared_scenes.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

struct Planned {
  PassList step;
  std::vector<LimitColor> colors;
  cpu::Wave wave;
};

// The first wave of a step of an explicit sheet with a strain limit and a ball.
Planned limitedSheet() {
  Scene scene = test::withLimiter(test::sheetScene(9));
  scene.colliders = {Sphere{}};
  const Cloth cloth(scene);
  Planned planned{makeStep(scene, cloth), makeLimitColors(cloth.pieces()[0]), {}};
  const std::span<const PassCall> passes = planned.step.passes;
  planned.wave = cpu::makeWave(passes.first(cpu::waveLength(passes)), planned.colors);
  return planned;
}

TEST(Wave, TakesAWholeExplicitStep) {
  const Planned planned = limitedSheet();
  EXPECT_EQ(cpu::waveLength(planned.step.passes), planned.step.passes.size());
  EXPECT_EQ(planned.wave.passes.size(), 3u + 12u + 1u) << "of each slot two colours, and the look at the end";
}

TEST(Wave, EndsBeforeWhatNeedsAllParticles) {
  Scene scene = test::withLimiter(test::sheetScene(9));
  scene.solver.selfCollision = SelfCollision::averaged;
  scene.cloths[0].thickness = 0.01;
  const PassList step = makeStep(scene, Cloth(scene));
  EXPECT_EQ(cpu::waveLength(step.passes), 2u);
  EXPECT_EQ(step.passes[2].pass, Pass::checkHash);
  const std::vector<PassCall> sums{{Pass::predictPlanes}, {Pass::begin}};
  EXPECT_EQ(cpu::waveLength(sums), 1u) << "a scalar is of no row";
}

// By hand: springs along a row need no other row; those to the row above make the next pass wait for one.
TEST(Wave, IsAsFarBehindAsSpringsReach) {
  const Planned planned = limitedSheet();
  const cpu::Wave& wave = planned.wave;
  std::vector<int> behind, inside;
  for (const cpu::WavePass& pass : wave.passes) {
    behind.push_back(pass.behind);
    inside.push_back(pass.inside);
  }
  EXPECT_EQ(behind, (std::vector{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 8, 10}));
  EXPECT_EQ(inside, (std::vector{0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 8, 10, 10}));
}

// Bands in any order, then seams, do each row of each pass once, and none before what it needs: the rows of
// earlier passes that a spring joins to it, which are at most two away.
TEST(Wave, DoesEveryRowOnceAndInOrder) {
  const Planned planned = limitedSheet();
  const cpu::Wave& wave = planned.wave;
  const int rows = 3 * wave.leastBand() + 1;
  const std::vector<int> seams{0, wave.leastBand(), 2 * wave.leastBand(), rows};
  std::set<std::pair<std::size_t, int>> done;
  const auto work = [&](std::size_t k, int row) {
    EXPECT_TRUE(row >= 0 && row < rows);
    EXPECT_TRUE(done.insert({k, row}).second) << "pass " << k << ", row " << row << " twice";
    if (wave.passes[k].color == nullptr) return;
    const int above = springOffsets[wave.passes[k].color->slot].rows;  // its springs join [row + above, row]
    for (std::size_t earlier = 0; earlier < k; ++earlier) {
      const LimitColor* color = wave.passes[earlier].color;
      const int reach = color == nullptr ? 0 : -springOffsets[color->slot].rows;
      for (int other = row + above; other <= row + reach; ++other)
        EXPECT_TRUE(other < 0 || other >= rows || done.contains({earlier, other}))
            << "pass " << k << ", row " << row << " before pass " << earlier << ", row " << other;
    }
  };
  for (const std::size_t band : {2u, 0u, 1u}) cpu::runBand(wave, seams[band], seams[band + 1], rows, work);
  for (const std::size_t seam : {1u, 2u}) cpu::runSeam(wave, seams[seam], work);
  EXPECT_EQ(done.size(), wave.passes.size() * static_cast<std::size_t>(rows));
}

// Of a sheet that the limit acts on, in several bands.
TEST(Wave, HasTheBitsOfPassesOneByOne) {
  Scene scene = test::withLimiter(test::vertical(test::sheetScene(121)));
  scene.solver.strainLimit = 0.001;
  scene.solver.simulationSteps = 400;
  const auto stepped = [](const Scene& of, bool sweeps) {
    const Cloth cloth(of);
    CpuSolver<float> solver(cloth, of, sweeps);
    solver.step(60);
    return stateHash(solver.state());
  };
  const int usual = ThreadTeam::shared().threads();
  const std::uint64_t oneByOne = stepped(scene, false);
  Scene unlimited = scene;
  unlimited.solver.strainLimit.reset();
  EXPECT_NE(stepped(unlimited, true), oneByOne);
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam::setSharedThreads(threads);
    EXPECT_EQ(stepped(scene, true), oneByOne) << threads << " threads";
  }
  ThreadTeam::setSharedThreads(usual);
}

}  // namespace
}  // namespace clothsim
