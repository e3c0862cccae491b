// Why cloth on a sphere is never pierced by the drawn sphere. Needs no context.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/colliders/surface.h"

namespace clothsim {
namespace {

// The least distance from the centre that a flat right triangle reaches when its corners lie on the sphere.
double dipOfTriangle(double radius, double spacing) {
  // Its circumscribed circle has the hypotenuse as diameter; the triangle is nearest to the centre at that
  // circle's middle.
  const double half = 0.5 * std::sqrt(2.0) * spacing;
  return std::sqrt(radius * radius - half * half);
}

TEST(SphereShrinkTest, KeepsTheDrawnSphereBelowEveryTriangleOfClothLyingOnIt) {
  for (const double radius : {0.05, 0.2, 1.0}) {
    for (const double spacing : {0.001, 0.0204, 0.05}) {
      const double drawn = radius - sphereShrink(radius, std::sqrt(2.0) * spacing);
      EXPECT_LT(drawn, dipOfTriangle(radius, spacing)) << "radius " << radius << ", spacing " << spacing;
    }
  }
}

TEST(SphereShrinkTest, StaysTooSmallToSeeOnFineCloth) { EXPECT_LT(sphereShrink(0.2, 0.0289), 0.01 * 0.2); }

TEST(SphereShrinkTest, LeavesASphereToSeeUnderClothFarTooCoarseForIt) {
  EXPECT_LE(sphereShrink(0.1, 5.0), 0.05);
  EXPECT_GT(sphereShrink(0.1, 5.0), 0);
}

}  // namespace
}  // namespace clothsim
