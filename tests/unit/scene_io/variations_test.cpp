// The axes of a sweep and its table of combinations.
#include "scene_io/variations.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using Values = std::vector<std::string>;

SweepTable tableOf(const Values& texts, double aspect = 4.0 / 3.0) {
  std::vector<Variation> variations;
  for (const std::string& text : texts) variations.push_back(parseVariation(text));
  return {std::move(variations), aspect};
}

// Cell by cell "a b c".
Values cellsOf(const SweepTable& table) {
  Values cells;
  for (std::size_t cell = 0; cell < table.cells(); ++cell) {
    cells.emplace_back();
    for (std::size_t i = 0; i < table.variations().size(); ++i)
      cells.back() += (i > 0 ? " " : "") + table.value(cell, i);
  }
  return cells;
}

TEST(Variations, AreAKeyAndItsValues) {
  EXPECT_EQ(parseVariation("cloth.ks=500,5000,5e4"), (Variation{"cloth.ks", {"500", "5000", "5e4"}}));
  EXPECT_EQ(parseVariation("solver.integrator=verlet").values, Values{"verlet"});
}

TEST(Variations, KeepTheCommasOfListsObjectsAndTexts) {
  EXPECT_EQ(parseVariation("gravity=[0,-9.8,0],[0,-1.6,0]").values, (Values{"[0,-9.8,0]", "[0,-1.6,0]"}));
  EXPECT_EQ(parseVariation(R"(cloth.pinned=["top"],[{"from":[0,0],"to":[3,0]}])").values,
            (Values{R"(["top"])", R"([{"from":[0,0],"to":[3,0]}])"}));
  EXPECT_EQ(parseVariation(R"(name="a,b","c\",d",e)").values, (Values{R"("a,b")", R"("c\",d")", "e"}));
}

TEST(Variations, SayWhatIsWrongWithThem) {
  for (const char* text : {"cloth.ks", "=1,2", "cloth.ks=", "cloth.ks=1,,2", "cloth.ks=1,", "cloth.ks=1,2,1"})
    EXPECT_NE(test::messageThrownBy<UsageError>([&] { (void)parseVariation(text); }).find(text),
              std::string::npos)
        << text;
}

TEST(SweepTable, PutsTheFirstAlongTheColumnsAndTheSecondDownTheRows) {
  const SweepTable table = tableOf({"ks=1,2,3", "i=a,b"});
  EXPECT_EQ(table.columns(), 3u);
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_FALSE(table.isWrapped());
  EXPECT_EQ(cellsOf(table), (Values{"1 a", "2 a", "3 a", "1 b", "2 b", "3 b"}));
}

TEST(SweepTable, GroupsTheRowsOfThreeBySecond) {
  const SweepTable table = tableOf({"ks=1,2", "i=a,b", "f=x,y,z"});
  EXPECT_EQ(table.columns(), 2u);
  EXPECT_EQ(table.rows(), 6u);
  EXPECT_EQ(cellsOf(table), (Values{"1 a x", "2 a x", "1 a y", "2 a y", "1 a z", "2 a z", "1 b x", "2 b x",
                                    "1 b y", "2 b y", "1 b z", "2 b z"}));
}

TEST(SweepTable, WrapsASingleOneIntoRowsThatFitAScreen) {
  EXPECT_EQ(tableOf({"k=1,2,3,4"}).columns(), 4u);
  const SweepTable ten = tableOf({"k=1,2,3,4,5,6,7,8,9,10"});
  EXPECT_EQ(ten.columns(), 5u) << "two full rows rather than three with two empty places";
  EXPECT_EQ(ten.rows(), 2u);
  EXPECT_TRUE(ten.isWrapped());
  EXPECT_EQ(cellsOf(ten).back(), "10");
  EXPECT_EQ(tableOf({"k=1,2,3,4,5,6"}).columns(), 3u);
  const SweepTable seven = tableOf({"k=1,2,3,4,5,6,7"});
  EXPECT_EQ(seven.columns(), 4u);
  EXPECT_EQ(seven.rows(), 2u) << "the last row is short";
  EXPECT_EQ(tableOf({"k=1,2,3,4,5"}, 0.01).columns(), 5u) << "never more columns than cells";
}

TEST(SweepTable, RefusesAKeyTwiceAndMoreThanCanBeRead) {
  EXPECT_THROW(tableOf({}), UsageError);
  EXPECT_THROW(tableOf({"k=1,2", "k=3"}), UsageError);
  Variation columns{"k", {}}, rows{"l", {}};
  for (int i = 0; i < 40; ++i) {
    columns.values.push_back(std::to_string(i));
    rows.values.push_back(std::to_string(i));
  }
  EXPECT_THROW(SweepTable({columns, rows}, 1), UsageError);
}

}  // namespace
}  // namespace clothsim
