#include "core/recent.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

using Numbers = Recent<char, int>;

TEST(Recent, KeepsTheLatestAndForgetsWhatWasUsedLongestAgo) {
  Numbers recent(10);
  recent.add('a', std::make_shared<const int>(1), 4);
  recent.add('b', std::make_shared<const int>(2), 4);
  EXPECT_EQ(*recent.find('a'), 1) << "which is the latest now";
  recent.add('c', std::make_shared<const int>(3), 4);
  EXPECT_EQ(recent.find('b'), nullptr);
  EXPECT_EQ(*recent.find('a'), 1);
  EXPECT_EQ(*recent.find('c'), 3);
}

TEST(Recent, KnowsWhatIsHeldHoweverMuchThatIs) {
  Numbers recent(10);
  const auto held = std::make_shared<const int>(1);
  recent.add('a', held, 100);
  for (char key = 'b'; key < 'z'; ++key) recent.add(key, std::make_shared<const int>(0), 4);
  EXPECT_EQ(recent.find('a'), held);
}

TEST(Recent, ForgetsWhatAloneIsTooLargeOnceNobodyHoldsIt) {
  Numbers recent(10);
  auto large = std::make_shared<const int>(1);
  const std::weak_ptr<const int> gone = large;
  recent.add('a', std::move(large), 11);
  EXPECT_TRUE(gone.expired());
  EXPECT_EQ(recent.find('a'), nullptr);
}

TEST(Recent, TakesTheNewForTheOld) {
  Numbers recent(10);
  recent.add('a', std::make_shared<const int>(1), 1);
  recent.add('a', std::make_shared<const int>(2), 1);
  EXPECT_EQ(*recent.find('a'), 2);
}

}  // namespace
}  // namespace clothsim
