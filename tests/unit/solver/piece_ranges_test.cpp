// Entries of several cloths are shared by threads as one job: each is visited once, whatever the threads
// take.
#include "solver/cpu/piece_ranges.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <utility>

namespace clothsim {
namespace {

TEST(PieceRanges, AreVisitedOnceEntryByEntry) {
  cpu::PieceRanges ranges;
  EXPECT_EQ(ranges.size(), 0u);
  ranges.forEach(1, [](const cpu::PieceRange&) { FAIL() << "nothing was added"; });
  ranges.add(0, 5, 3);
  ranges.add(2, 100, 0);  // a cloth without any
  ranges.add(3, 0, 40);
  ranges.add(4, 7, 1);
  ASSERT_EQ(ranges.size(), 44u);
  const int usual = ThreadTeam::shared().threads();
  for (const int threads : {1, 3}) {
    ThreadTeam::setSharedThreads(threads);
    for (const std::uint32_t atOnce : {1u, 2u, 7u, 100u}) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> visits;
      std::mutex mutex;
      ranges.forEach(atOnce, [&](const cpu::PieceRange& range) {
        const std::scoped_lock lock(mutex);
        for (std::uint32_t i = range.begin; i < range.end; ++i) ++visits[{range.piece, i}];
      });
      EXPECT_EQ(visits.size(), 44u) << atOnce << " at once";
      for (const auto& [entry, count] : visits) EXPECT_EQ(count, 1) << entry.first << ", " << entry.second;
      EXPECT_TRUE(visits.contains({0, 5}) && visits.contains({3, 39}) && visits.contains({4, 7}));
    }
  }
  ThreadTeam::setSharedThreads(usual);
  int entries = 0;
  ranges.forEach(3, 10, 100, [&](const cpu::PieceRange& range) {
    EXPECT_EQ(range.piece, 3u) << "of the cloth that begins with number 3";
    entries += static_cast<int>(range.end - range.begin);
  });
  EXPECT_EQ(entries, 7);
}

}  // namespace
}  // namespace clothsim
