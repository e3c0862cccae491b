#include "scene/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clothsim {
namespace {

// Areas of the triangles, which lie in z = 0 and go round counter-clockwise.
std::vector<double> areasOf(const std::vector<Vec3d>& polygon) {
  std::vector<double> areas;
  for (const auto& [a, b, c] : trianglesOf(polygon))
    areas.push_back(0.5 * cross(polygon[b] - polygon[a], polygon[c] - polygon[a]).z);
  return areas;
}

void expectCovered(const std::vector<Vec3d>& polygon, double area) {
  const std::vector<double> areas = areasOf(polygon);
  EXPECT_EQ(areas.size(), polygon.size() - 2);
  double sum = 0;
  for (const double each : areas) {
    EXPECT_GT(each, 1e-6 * area);
    sum += each;
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(Polygon, OfFourCornersIsSplitByTheShorterDiagonal) {
  EXPECT_EQ(trianglesOf(std::vector<Vec3d>{{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0, 1, 0}}),
            (std::vector<std::array<std::size_t, 3>>{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(trianglesOf(std::vector<Vec3d>{{0, 0, 0}, {2.5, 0, 0}, {2, 1, 0}, {0, 1, 0}}),
            (std::vector<std::array<std::size_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, IsCoveredOnceAlsoWhereItIsHollow) {
  expectCovered({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 7);
  expectCovered({{0, 0, 0}, {4, -1, 0}, {0.5, 0.4, 0}, {0, 4, 0}}, 2.05);  // an arrowhead
  expectCovered({{0, 0, 0}, {1, 0.1, 0}, {2, 0, 0}, {1, 0.2, 0}},
                0.1);  // whose shorter diagonal is the right one
}

TEST(Polygon, MayHaveCornersAlongItsSides) {
  expectCovered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, 4);
  expectCovered({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0, 3, 0}}, 0.3);
}

TEST(Polygon, IsCoveredWhateverItsShape) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  for (int corners = 5; corners < 60; ++corners) {
    std::vector<Vec3d> star;
    double area = 0;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * 3.14159265358979 * k / corners, radius = uniform(engine);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (int k = 0; k < corners; ++k)
      area +=
          0.5 * cross(star[static_cast<std::size_t>(k)], star[static_cast<std::size_t>((k + 1) % corners)]).z;
    expectCovered(star, area);
  }
}

TEST(Polygon, GetsTrianglesAlsoWhereItCrossesItselfOrHasNoArea) {
  EXPECT_EQ(trianglesOf(std::vector<Vec3d>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 2, 0}}).size(),
            3u);
  EXPECT_EQ(trianglesOf(std::vector<Vec3d>(6)).size(), 4u);
}

}  // namespace
}  // namespace clothsim
