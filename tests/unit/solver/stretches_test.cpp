// Entries of several cloths are shared by threads as one job: each is visited once, whatever the threads
// take.
#include "solver/cpu/stretches.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <utility>

namespace clothsim {
namespace {

TEST(Stretches, AreVisitedOnceEntryByEntry) {
  cpu::Stretches stretches;
  EXPECT_EQ(stretches.size(), 0u);
  stretches.forEach(1, [](const cpu::Stretch&) { FAIL() << "nothing was added"; });
  stretches.add(0, 5, 3);
  stretches.add(2, 100, 0);  // a cloth without any
  stretches.add(3, 0, 40);
  stretches.add(4, 7, 1);
  ASSERT_EQ(stretches.size(), 44u);
  const int usual = ThreadTeam::shared().threads();
  for (const int threads : {1, 3}) {
    ThreadTeam::setSharedThreads(threads);
    for (const std::uint32_t atOnce : {1u, 2u, 7u, 100u}) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> visits;
      std::mutex mutex;
      stretches.forEach(atOnce, [&](const cpu::Stretch& stretch) {
        const std::scoped_lock lock(mutex);
        for (std::uint32_t i = stretch.begin; i < stretch.end; ++i) ++visits[{stretch.piece, i}];
      });
      EXPECT_EQ(visits.size(), 44u) << atOnce << " at once";
      for (const auto& [entry, count] : visits) EXPECT_EQ(count, 1) << entry.first << ", " << entry.second;
      EXPECT_TRUE(visits.contains({0, 5}) && visits.contains({3, 39}) && visits.contains({4, 7}));
    }
  }
  ThreadTeam::setSharedThreads(usual);
  int entries = 0;
  stretches.forEach(3, 10, 100, [&](const cpu::Stretch& stretch) {
    EXPECT_EQ(stretch.piece, 3u) << "of the cloth that begins with number 3";
    entries += static_cast<int>(stretch.end - stretch.begin);
  });
  EXPECT_EQ(entries, 7);
}

}  // namespace
}  // namespace clothsim
