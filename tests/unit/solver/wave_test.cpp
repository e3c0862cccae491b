// Passes that go down the rows together, each behind what it needs.
#include "solver/cpu/wave.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/thread_team.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/wave_bands.h"
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
  Planned planned{makeStep(scene, cloth, mostLevels(cloth, {})), makeLimitColors(cloth.pieces()[0]), {}};
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
  const Cloth cloth(scene);
  const PassList step = makeStep(scene, cloth, mostLevels(cloth, {}));
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

// Expects each row of each pass once, and none before what it needs: the rows of earlier passes that a spring
// joins to it, which are at most two away.
class OrderOfRows {
 public:
  OrderOfRows(const cpu::Wave& wave, int rows) : wave_(&wave), rows_(rows) {}
  ~OrderOfRows() { EXPECT_EQ(done_.size(), wave_->passes.size() * static_cast<std::size_t>(rows_)); }

  void isDone(std::size_t k, int row) {
    EXPECT_TRUE(row >= 0 && row < rows_);
    const std::lock_guard lock(mutex_);
    // Springs of a colour join [row - rows of its springs, row].
    const auto rowsOfSprings = [&](std::size_t pass) {
      const LimitColor* color = wave_->passes[pass].color;
      return color == nullptr ? 0 : -springOffsets[color->slot].rows;
    };
    for (std::size_t earlier = 0; earlier < k; ++earlier)
      for (int other = row - rowsOfSprings(k); other <= row + rowsOfSprings(earlier); ++other)
        EXPECT_TRUE(other < 0 || other >= rows_ || done_.contains({earlier, other}))
            << "pass " << k << ", row " << row << " before pass " << earlier << ", row " << other;
    EXPECT_TRUE(done_.insert({k, row}).second) << "pass " << k << ", row " << row << " twice";
  }

 private:
  const cpu::Wave* wave_;
  int rows_;
  std::mutex mutex_;
  std::set<std::pair<std::size_t, int>> done_;
};

TEST(Wave, DoesEveryRowOnceAndInOrder) {
  const Planned planned = limitedSheet();
  for (const int rows : {61, 9, 1}) {
    OrderOfRows order(planned.wave, rows);
    cpu::runWave(planned.wave, rows, [&](std::size_t k, int row) { order.isDone(k, row); });
  }
}

struct BandsCase {
  int rows, bands;
};
// Bands of more rows than the wave is long, and of fewer, down to one.
class WaveBandsOf : public testing::TestWithParam<BandsCase> {
 protected:
  void run(cpu::WaveBands<float>& bands, int threads) const {
    OrderOfRows order(planned_.wave, GetParam().rows);
    ThreadTeam team(threads);
    bands.begin();
    team.forEach(0, bands.count(), 1, [&](std::uint32_t band) {
      EXPECT_TRUE(bands.run(band, 9, [&](std::size_t k, int row, cpu::ForceRows<float>& forces) {
        forces.clear(0, row);  // a band has rows of its own
        order.isDone(k, row);
      }));
    });
  }
  Planned planned_ = limitedSheet();
};

TEST_P(WaveBandsOf, DoEveryRowOnceAndInOrder) {
  for (const int threads : {1, 2, 3}) {
    cpu::WaveBands<float> bands(planned_.wave, GetParam().rows, GetParam().bands);
    for (int step = 0; step < 4; ++step) run(bands, threads);  // between them, seams may move
  }
}
INSTANTIATE_TEST_SUITE_P(Rows, WaveBandsOf,
                         testing::Values(BandsCase{61, 2}, BandsCase{61, 3}, BandsCase{9, 3},
                                         BandsCase{5, 5}));

// Bands begin with 12 rows each, and a seam moves by one at a time.
TEST(WaveBands, GiveFewerRowsToWhoTakesLonger) {
  const Planned planned = limitedSheet();
  constexpr int rows = 24;
  cpu::WaveBands<float> bands(planned.wave, rows, 2);
  std::array<int, 2> done{};
  for (int step = 0; step < 16; ++step) {
    bands.begin();
    done = {};
    for (const std::uint32_t band : {1u, 0u})
      EXPECT_TRUE(bands.run(band, 9, [&](std::size_t k, int, cpu::ForceRows<float>&) {
        if (k != 0) return;
        done[band] += 1;
        if (band == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }));
  }
  EXPECT_EQ(done[0] + done[1], rows);
  EXPECT_LT(3 * done[0], done[1]);
}

// Of a sheet that the limit acts on, in bands of many rows and of few.
class WaveOnThreads : public testing::TestWithParam<int> {};

TEST_P(WaveOnThreads, HasTheBitsOfPassesOneByOne) {
  Scene scene = test::withLimiter(test::vertical(test::sheetScene(GetParam())));
  scene.solver.strainLimit = 0.0001;
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
INSTANTIATE_TEST_SUITE_P(Columns, WaveOnThreads, testing::Values(49, 121));

}  // namespace
}  // namespace clothsim
