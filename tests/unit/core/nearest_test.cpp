#include "core/nearest.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

const std::vector<std::string> keys{"density", "damping",          "stiffness_reference",
                                    "ks",      "num_width_points", "width"};

// Distances counted by hand.
TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(editDistance("damping", "damping"), 0);
  EXPECT_EQ(editDistance("damping", "daping"), 1);
  EXPECT_EQ(editDistance("daping", "damping"), 1);
  EXPECT_EQ(editDistance("damping", "damqing"), 1);
  EXPECT_EQ(editDistance("damping", "dampign"), 1);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);
  EXPECT_EQ(editDistance("", "abc"), 3);
  EXPECT_EQ(editDistance("abc", ""), 3);
}

TEST(EditDistance, TakesUpperCaseAndHyphensAsEqual) {
  EXPECT_EQ(editDistance("Num-Width-Points", "num_width_points"), 0);
}

TEST(NearestWord, FindsTheKeyThatWasMeant) {
  EXPECT_EQ(nearestWord("dampng", keys), "damping");
  EXPECT_EQ(nearestWord("denstiy", keys), "density");
  EXPECT_EQ(nearestWord("numWidthPoints", keys), "num_width_points");
}

TEST(NearestWord, TakesTheBeginningOfAWordForTheWord) {
  EXPECT_EQ(nearestWord("stiffness", keys), "stiffness_reference");
}

TEST(NearestWord, OffersNothingForAWordThatIsFarFromAll) {
  EXPECT_EQ(nearestWord("colour", keys), std::nullopt);
  EXPECT_EQ(nearestWord("", keys), std::nullopt);
  EXPECT_EQ(nearestWord("damping", {}), std::nullopt);
  EXPECT_EQ(nearestWord(std::string(1'000'000, 'x'), keys), std::nullopt);
}

TEST(DidYouMean, IsAQuestionOrNothing) {
  EXPECT_EQ(didYouMean("dampng", keys), "; did you mean \"damping\"?");
  EXPECT_EQ(didYouMean("colour", keys), "");
}

}  // namespace
}  // namespace clothsim
