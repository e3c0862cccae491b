// The coarse levels of the implicit integrator's preconditioner.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cloth/cuts.h"
#include "solver/cpu/cpu_solver.h"
#include "solver/cpu/prolongation.h"
#include "solver/hierarchy.h"
#include "support/grabs.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

const Material clothOfLevels{.density = 0.2, .stretch = 3000, .shear = 700, .bend = 1e-3, .damping = 2};

Hierarchy<double> levelsOf(const Scene& scene, const Cuts& cuts = {}) {
  const Cloth cloth(scene);
  return makeHierarchy<double>(cloth, cuts);
}

// The weights of every vertex that is not on the coarsest level.
void expectWeightsToAddUpToOne(const Hierarchy<double>& levels) {
  for (const std::vector<LevelParams>& piece : levels.pieces)
    for (const LevelParams& level : piece)
      for (std::uint32_t i = level.fineFirst; i < level.fineFirst + level.fineCount; ++i) {
        double sum = 0;
        for (auto n = levels.prolongationStarts[i]; n < levels.prolongationStarts[i + 1]; ++n) {
          const auto& [vertex, weight] = levels.prolongation[n];
          EXPECT_GE(vertex, level.coarseFirst);
          EXPECT_LT(vertex, level.coarseFirst + level.coarseCount);
          EXPECT_GT(weight, 0);
          sum += weight;
        }
        EXPECT_NEAR(sum, 1, 1e-12) << i;
      }
}

TEST(Hierarchy, HangsEveryVertexOnTheNextLevelByWeightsOfOneInAll) {
  for (const int n : {2, 9, 65}) {
    const Hierarchy<double> levels = levelsOf(test::materialSheet(n, n, 1, 1, clothOfLevels));
    expectWeightsToAddUpToOne(levels);
    EXPECT_LE(levels.pieces[0].back().coarseCount, COARSEST_VERTICES) << n;
  }
}

TEST(Hierarchy, RestrictsAsItProlongs) {
  const Hierarchy<double> levels = levelsOf(test::materialSheet(20, 31, 1, 1, clothOfLevels));
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> weights;
  for (std::uint32_t i = 0; i + 1 < levels.prolongationStarts.size(); ++i)
    for (auto n = levels.prolongationStarts[i]; n < levels.prolongationStarts[i + 1]; ++n)
      weights[{i, levels.prolongation[n].vertex}] = levels.prolongation[n].weight;
  std::size_t same = 0;
  for (std::uint32_t c = 0; c < levels.coarseVertices; ++c)
    for (auto n = levels.restrictionStarts[c]; n < levels.restrictionStarts[c + 1]; ++n)
      same += weights.at({levels.restriction[n].vertex, c}) == levels.restriction[n].weight ? 1 : 0;
  EXPECT_EQ(same, weights.size());
}

TEST(Hierarchy, ProlongsBySixteenParticlesAsOneByOne) {
  const Hierarchy<double> levels = levelsOf(test::materialSheet(20, 31, 1, 1, clothOfLevels));
  const cpu::ProlongationBySixteen<double> bySixteen = cpu::prolongationBySixteen(levels);
  for (std::uint32_t i = 0; i < levels.particles; ++i) {
    std::uint32_t next = levels.prolongationStarts[i];
    for (auto n = bySixteen.starts[i / 16]; n < bySixteen.starts[i / 16 + 1]; ++n) {
      const auto [coarse, number] = bySixteen.entries[n];
      const double weight = bySixteen.weights[number].of[i % 16];
      if (weight == 0) continue;
      ASSERT_LT(next, levels.prolongationStarts[i + 1]) << i;
      EXPECT_EQ(coarse, levels.prolongation[next].vertex) << i;
      EXPECT_EQ(weight, levels.prolongation[next++].weight) << i;
    }
    EXPECT_EQ(next, levels.prolongationStarts[i + 1]) << i;
  }
  EXPECT_LT(2 * bySixteen.weights.size(), bySixteen.entries.size()) << "on a grid they recur";
}

// A block is there for every two aggregates that some element touches, and once.
TEST(Hierarchy, HasTheDiagonalBlockFirstInEveryRow) {
  const Hierarchy<double> levels = levelsOf(test::materialSheet(30, 30, 1, 1, clothOfLevels));
  for (std::uint32_t row = 0; row < levels.coarseVertices; ++row) {
    ASSERT_LT(levels.blockStarts[row], levels.blockStarts[row + 1]);
    for (auto n = levels.blockStarts[row]; n < levels.blockStarts[row + 1]; ++n) {
      EXPECT_EQ(levels.blocks[n].row, row);
      if (n == levels.blockStarts[row])
        EXPECT_EQ(levels.blocks[n].column, row);
      else
        EXPECT_GT(levels.blocks[n].column, levels.blocks[n - 1].column);
      EXPECT_LT(levels.blocks[n].firstSource, levels.blocks[n].endSource);
    }
  }
}

// It is summed up from what the diagonal block is.
TEST(Hierarchy, EndsEveryRowWithTheBlockOfAllVertices) {
  const Hierarchy<double> levels = levelsOf(test::materialSheet(30, 30, 1, 1, clothOfLevels));
  const auto isOfAll = [](const auto& block) { return block.column == ALL_VERTICES; };
  EXPECT_EQ(std::count_if(levels.blocks.begin(), levels.blocks.end(), isOfAll), levels.coarseVertices);
  for (std::uint32_t row = 0; row < levels.coarseVertices; ++row) {
    const auto &diagonal = levels.blocks[levels.blockStarts[row]],
               &last = levels.blocks[levels.blockStarts[row + 1] - 1];
    EXPECT_TRUE(isOfAll(last)) << row;
    const bool isOfParticles = row < levels.pieces[0][0].coarseCount;
    if (isOfParticles)
      EXPECT_EQ(last.endSource - last.firstSource, diagonal.endSource - diagonal.firstSource) << row;
    else
      EXPECT_EQ(last.endSource - last.firstSource,
                levels.restrictionStarts[row + 1] - levels.restrictionStarts[row])
          << row;
  }
}

TEST(Hierarchy, LetsNoWeightCrossACut) {
  const int n = 24;
  const Scene scene = test::materialSheet(n, n, 1, 1, clothOfLevels);
  const Cloth cloth(scene);
  const int rowsCutOff = 11;
  const Hierarchy<double> levels = levelsOf(scene, test::cutAcross(cloth, rowsCutOff - 0.5));
  expectWeightsToAddUpToOne(levels);
  EXPECT_EQ(levels.parts[0].size(), 2u) << "a matrix for each of the two pieces of cloth";
  std::vector<int> sides(levels.coarseVertices);  // bit 0: above the cut, bit 1: below
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    for (auto k = levels.prolongationStarts[i]; k < levels.prolongationStarts[i + 1]; ++k)
      sides[levels.prolongation[k].vertex] |= i < static_cast<std::uint32_t>(n * rowsCutOff) ? 1 : 2;
  const LevelParams& first = levels.pieces[0][0];
  EXPECT_EQ(
      std::count(sides.begin() + first.coarseFirst, sides.begin() + first.coarseFirst + first.coarseCount, 3),
      0);
}

// A cloth cut into a long ribbon needs more levels than the whole: the step has passes for all of them.
TEST(Hierarchy, HasPassesForEveryLevelOfACutCloth) {
  Scene scene = test::materialSheet(30, 30, 1, 1, clothOfLevels);
  scene.solver.integrator = Integrator::implicit;
  const Cloth cloth(scene);
  Cuts cuts(cloth.particleCount());
  for (std::uint32_t row = 1; row < 30; ++row)
    for (std::uint32_t column = 0; column < 30; ++column) {
      const bool joins = column == (row % 2 == 0 ? 0u : 29u);
      cuts[30 * row + column] = static_cast<std::uint8_t>(1u << toUpperLeft | 1u << toUpperRight |
                                                          1u << toSecondUpper | (joins ? 0 : 1u << toUpper));
    }
  CpuSolver<float> solver(cloth, scene);
  const auto levelsIn = [&] {
    std::size_t count = 0;
    for (const PassCall& call : solver.passes().passes)
      if (call.pass == Pass::coarsen) count = std::max<std::size_t>(count, call.index + 1);
    return count;
  };
  EXPECT_EQ(levelsIn(), levelsOf(scene).pieces[0].size());
  solver.setCuts(cuts);
  EXPECT_EQ(levelsIn(), levelsOf(scene, cuts).pieces[0].size());
  EXPECT_GT(levelsOf(scene, cuts).pieces[0].size(), levelsOf(scene).pieces[0].size());
}

}  // namespace
}  // namespace clothsim
