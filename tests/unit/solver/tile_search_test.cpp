// Which particles are near each other, against a look at every pair.
#include "solver/cpu/tile_search.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>

#include "support/mesh_sheet.h"
#include "support/point_clouds.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

using Pairs = std::multiset<std::pair<std::uint32_t, std::uint32_t>>;

// Sheets of 21 x 6 and of 7 x 7 particles, whose last tiles are not full, and a mesh of 30.
Scene twoSheetsAndAMesh() {
  Scene scene = test::meshScene({.columns = 5, .rows = 6});
  for (const auto& [columns, rows] : {std::pair{21, 6}, {7, 7}}) {
    ClothSettings& sheet = scene.cloths.emplace_back();
    sheet.numWidthPoints = columns;
    sheet.numHeightPoints = rows;
  }
  return scene;
}

bool areOfOneCell(const Cloth& cloth, std::uint32_t i, std::uint32_t j) {
  for (const Piece& piece : cloth.pieces()) {
    const std::uint32_t a = i - piece.firstParticle, b = j - piece.firstParticle;
    if (piece.isMesh || a >= piece.particleCount() || b >= piece.particleCount()) continue;
    const int first = static_cast<int>(a), second = static_cast<int>(b);
    return std::abs(first % piece.columns - second % piece.columns) <= 1 &&
           std::abs(first / piece.columns - second / piece.columns) <= 1;
  }
  return false;
}

void compare(const Cloth& cloth, const Components<float>& points, float reach, bool neighbors) {
  Pairs wanted, found;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    for (std::uint32_t j = 0; j < cloth.particleCount(); ++j) {
      const Vec3f d{points.x[i] - points.x[j], points.y[i] - points.y[j], points.z[i] - points.z[j]};
      if (dot(d, d) < reach * reach && (neighbors || !areOfOneCell(cloth, i, j))) wanted.insert({i, j});
    }
  cpu::TileSearch<float> search(cloth);
  search.setPositions(points);
  for (std::uint32_t group = 0; group < search.groups(); ++group)
    search.find(
        group, reach * reach, neighbors, [&](std::uint32_t tile, std::span<const cpu::NearTile> others) {
          for (const cpu::NearTile& other : others)
            for (std::uint32_t k = 0; k < cpu::TILE; ++k)
              for (std::uint32_t near = other.near[k]; near != 0; near &= near - 1)
                found.insert(
                    {search.particlesOf(tile)[k], search.particlesOf(other.tile)[std::countr_zero(near)]});
        });
  EXPECT_GT(wanted.size(), 0u);
  EXPECT_EQ(found, wanted) << (neighbors ? "with" : "without") << " neighbours";
}

// In double precision the rows of hash candidates look at it.
TEST(TileSearch, FindsWhatALookAtEveryPairFinds) {
  const Scene scene = twoSheetsAndAMesh();
  const Cloth cloth(scene);
  Components<float> points = test::cloud(cloth.particleCount());
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 1);
  for (const float reach : {0.1f, 0.5f}) {
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
      points.x[i] = place(random);
      points.y[i] = place(random);
      points.z[i] = place(random);
    }
    for (const bool neighbors : {true, false}) compare(cloth, points, reach, neighbors);
  }
}

}  // namespace
}  // namespace clothsim
