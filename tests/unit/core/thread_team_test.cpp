#include "core/thread_team.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <set>

namespace clothsim {
namespace {

// How often each of [first, end) was visited, and how often what lies around it.
std::vector<int> visits(ThreadTeam& team, std::uint32_t first, std::uint32_t end, std::uint32_t grain) {
  std::vector<std::atomic<int>> counts(end + 3);
  team.forEach(first, end, grain, [&](std::uint32_t i) { ++counts[i]; });
  return {counts.begin(), counts.end()};
}

TEST(ThreadTeam, VisitsEachEntryOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (const std::uint32_t first : {0u, 5u})
      for (const std::uint32_t count : {0u, 1u, 2u, 7u, 64u, 1000u})
        for (const std::uint32_t grain : {1u, 3u, 2000u}) {
          std::vector<int> expected(first + count + 3);
          std::fill_n(expected.begin() + first, count, 1);
          EXPECT_EQ(visits(team, first, first + count, grain), expected)
              << threads << " threads, " << count << " entries from " << first << ", grain " << grain;
        }
  }
}

TEST(ThreadTeam, IsDoneWhenItReturnsJobAfterJob) {
  ThreadTeam team(4);
  std::vector<std::uint32_t> values(300);
  for (std::uint32_t round = 1; round <= 3000; ++round) {
    team.forEach(0, 300, 4, [&](std::uint32_t i) { values[i] += i; });
    if (round % 1000 == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // all have gone to sleep
    ASSERT_EQ(std::accumulate(values.begin(), values.end(), 0u), round * (300 * 299 / 2))
        << "round " << round;
  }
}

TEST(ThreadTeam, LeavesTheWorkToItsCallerWhileOthersWantTheCores) {
  ThreadTeam team(4);
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> byCaller = 0;
  {
    const WorkAlone whileDrawing(team);
    EXPECT_TRUE(team.worksAlone());
    team.forEach(0, 10'000, 1, [&](std::uint32_t) { byCaller += std::this_thread::get_id() == caller; });
  }
  EXPECT_EQ(byCaller, 10'000);
  EXPECT_FALSE(team.worksAlone());
  const WorkAlone onHardware(team, false);
  EXPECT_FALSE(team.worksAlone());
}

// A thread that is late with a short job must not take entries of the long one that follows as its own.
TEST(ThreadTeam, DoesEachEntryOnceWhenShortAndLongJobsFollowEachOther) {
  ThreadTeam team(2);
  std::atomic<std::uint64_t> visited = 0;
  std::uint64_t expected = 0;
  for (std::uint32_t job = 0; job < 500000; ++job) {
    const std::uint32_t count = job % 2 == 0 ? 4 : 80;
    expected += count;
    team.forEach(0, count, 1, [&](std::uint32_t) { ++visited; });
    ASSERT_EQ(visited, expected) << "job " << job;
  }
}

TEST(ThreadTeam, ServesCallersThatComeTogetherAndFromWithin) {
  ThreadTeam team(3);
  std::atomic<int> sum = 0;
  std::vector<std::thread> callers;
  for (int k = 0; k < 4; ++k)
    callers.emplace_back([&] {
      for (int round = 0; round < 200; ++round)
        team.forEach(0, 20, 1, [&](std::uint32_t) { team.forEach(0, 5, 1, [&](std::uint32_t) { ++sum; }); });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 4 * 200 * 20 * 5);
}

TEST(ThreadTeam, WorksOnSeveralThreads) {
  ThreadTeam team(2);
  std::mutex guard;
  std::set<std::thread::id> seen;
  for (int round = 0; round < 1000 && seen.size() < 2; ++round)
    team.forEach(0, 8, 1, [&](std::uint32_t) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      const std::lock_guard lock(guard);
      seen.insert(std::this_thread::get_id());
    });
  EXPECT_EQ(seen.size(), 2u);
}

TEST(ThreadTeam, LetsTheProgramEndWhileItComputes) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        std::thread([] {
          for (;;) ThreadTeam::shared().forEach(0, 1000, 1, [](std::uint32_t) {});
        }).detach();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        std::exit(3);
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace clothsim
