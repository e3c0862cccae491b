#include "cloth/cuts.h"

#include <gtest/gtest.h>

#include <set>

#include "support/test_scenes.h"

namespace clothsim {
namespace {

using test::sheetScene;

// Particles that can be reached from `start` over triangles.
std::set<std::uint32_t> pieceAround(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                    std::uint32_t start) {
  std::set<std::uint32_t> piece{start};
  for (std::size_t before = 0; before != piece.size();) {
    before = piece.size();
    for (const auto& t : triangles)
      if (piece.contains(t[0]) || piece.contains(t[1]) || piece.contains(t[2]))
        piece.insert(t.begin(), t.end());
  }
  return piece;
}

TEST(CutAlong, SeparatesTheSidesOfAStrokeAcrossTheSheet) {
  const Cloth cloth(sheetScene(10));
  for (const double lean : {0.0, 1.5, 4.2}) {
    Cuts cuts;
    EXPECT_TRUE(cutAlong(cuts, cloth, 0, {4.5 - lean, -1}, {4.5 + lean, 10}));
    const auto triangles = remainingTriangles(cloth, cuts);
    EXPECT_FALSE(pieceAround(triangles, 0).contains(99)) << lean;
    EXPECT_GT(triangles.size(), cloth.triangleCount() / 2) << "only what lies under the stroke goes";
    EXPECT_FALSE(cutAlong(cuts, cloth, 0, {4.5 - lean, -1}, {4.5 + lean, 10})) << "nothing is left to cut";
  }
}

TEST(CutAlong, SeparatesEvenAlongALineOfGridPoints) {
  const Cloth cloth(sheetScene(10));
  for (const LatticePoint to : {LatticePoint{4, 10}, LatticePoint{13, 9}}) {
    Cuts cuts;
    cutAlong(cuts, cloth, 0, {to.column == 4 ? 4.0 : 2.0, -2}, to);
    EXPECT_FALSE(pieceAround(remainingTriangles(cloth, cuts), 90).contains(9));
  }
}

TEST(CutAlong, SeparatesFromBorderToBorderAlongALineOfGridPoints) {
  const Cloth cloth(sheetScene(10));
  for (const auto& [from, to] : {std::pair{LatticePoint{0, 4}, LatticePoint{9, 4}},
                                 std::pair{LatticePoint{9, 4}, LatticePoint{0, 4}}}) {
    Cuts cuts;
    cutAlong(cuts, cloth, 0, from, to);
    EXPECT_FALSE(pieceAround(remainingTriangles(cloth, cuts), 0).contains(99));
  }
}

TEST(CutAlong, TearsTheSpringsUnderTheStrokeAndNoOthers) {
  const Cloth cloth(sheetScene(10));
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {4.5, 4.6}, {4.5, 5.4});  // across one structural spring of row 5
  const Piece& piece = cloth.pieces()[0];
  EXPECT_TRUE(isCut(cuts, piece.particle(5, 5), toLeft));
  EXPECT_TRUE(isCut(cuts, piece.particle(5, 5), toSecondLeft));
  EXPECT_TRUE(isCut(cuts, piece.particle(6, 5), toSecondLeft));
  int torn = 0;
  for (const std::uint8_t bits : cuts) torn += __builtin_popcount(bits);
  EXPECT_EQ(torn, 3);
  EXPECT_EQ(remainingTriangles(cloth, cuts).size(), cloth.triangleCount() - 2);
}

TEST(CutAlong, LeavesAnotherGridAndAMissedOneAlone) {
  Scene scene = sheetScene(5);
  scene.cloths.push_back(scene.cloths[0]);
  const Cloth cloth(scene);
  Cuts cuts;
  EXPECT_FALSE(cutAlong(cuts, cloth, 1, {10, 10}, {20, 10}));
  EXPECT_TRUE(cuts.empty());
  EXPECT_TRUE(cutAlong(cuts, cloth, 1, {-1, 2.5}, {6, 2.5}));
  for (std::uint32_t i = 0; i < 25; ++i) EXPECT_EQ(cuts[i], 0);
}

TEST(RemainingTriangles, AreAllOfThemWithoutCuts) {
  const Cloth cloth(sheetScene(6));
  EXPECT_EQ(remainingTriangles(cloth, {}), cloth.triangles());
}

// Against the lists of what is left.
TEST(CutMasks, NameTheSpringsAndTrianglesThatAParticleHasLost) {
  Scene scene = sheetScene(7);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 4;
  const Cloth cloth(scene);
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {2.5, -1}, {4.2, 4.4});
  cutAlong(cuts, cloth, 1, {-1, 3.3}, {2.2, 2.1});
  const std::vector<std::uint32_t> masks = makeCutMasks(cloth, cuts);
  const auto remaining = remainingTriangles(cloth, cuts);
  const std::set<std::array<std::uint32_t, 3>> left(remaining.begin(), remaining.end());
  std::uint64_t springsLost = 0, trianglesLost = 0;
  for (const Piece& piece : cloth.pieces()) {
    for (int row = 0; row < piece.rows; ++row) {
      for (int column = 0; column < piece.columns; ++column) {
        const std::uint32_t i = piece.particle(column, row);
        for (std::size_t k = 0; k < incidentSprings.size(); ++k) {
          const IncidentSpring& spring = incidentSprings[k];
          const int otherColumn = column + spring.columns, otherRow = row + spring.rows;
          const bool lost = (masks[i] >> k & 1) != 0;
          springsLost += lost;
          if (!piece.contains(otherColumn, otherRow)) {
            EXPECT_FALSE(lost);
            continue;
          }
          EXPECT_EQ(lost, isCut(cuts, spring.owned ? i : piece.particle(otherColumn, otherRow), spring.slot));
          EXPECT_EQ(springWithinCell(spring.columns, spring.rows), k);
        }
        for (std::size_t k = 0; k < incidentTriangles.size(); ++k) {
          std::array<std::uint32_t, 3> triangle{};
          bool exists = true;
          for (std::size_t corner = 0; corner < 3; ++corner) {
            const Corner& from = incidentTriangles[k][corner];
            exists = exists && piece.contains(column + from.columns, row + from.rows);
            if (exists) triangle[corner] = piece.particle(column + from.columns, row + from.rows);
          }
          const bool lost = (masks[i] >> (12 + k) & 1) != 0;
          trianglesLost += lost;
          EXPECT_EQ(lost, exists && !left.contains(triangle)) << i << ", " << k;
        }
      }
    }
  }
  EXPECT_EQ(springsLost, 2 * (cloth.springCount() - remainingSpringCount(cloth, cuts)));
  EXPECT_EQ(remainingTriangleCount(cloth, cuts), remaining.size());
  EXPECT_EQ(trianglesLost, 3 * (cloth.triangleCount() - remaining.size()));
  EXPECT_GT(trianglesLost, 20u);
  EXPECT_TRUE(makeCutMasks(cloth, {}).empty());
}

}  // namespace
}  // namespace clothsim
