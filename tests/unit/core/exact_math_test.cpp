#include "core/exact_math.h"

#include <gtest/gtest.h>

#include <limits>

namespace clothsim {
namespace {

// Error of an approximation of `exact` in units in the last place of its binary32 neighbourhood.
double errorInUlp(float approximation, double exact) {
  const float rounded = static_cast<float>(exact);
  const double ulp = static_cast<double>(std::nextafter(rounded, INFINITY)) - static_cast<double>(rounded);
  return std::abs(static_cast<double>(approximation) - exact) / ulp;
}

TEST(InverseSquareRoot, IsWithinOnePointTwoUlpForEveryMantissa) {
  double worst = 0;
  for (std::uint32_t bits = 0x3f800000u; bits < 0x40800000u;
       ++bits) {  // [1, 4): every mantissa, both parities
    const float x = floatFromBits(bits);
    worst = std::max(worst, errorInUlp(inverseSquareRoot(x), 1 / std::sqrt(static_cast<double>(x))));
  }
  EXPECT_LT(worst, 1.21) << "1.20 when the polynomial was chosen";
}

TEST(InverseSquareRoot, IsFiniteAtZeroSoThatZeroTimesItIsZero) {
  EXPECT_TRUE(std::isfinite(inverseSquareRoot(0.0f)));
  EXPECT_EQ(0.0f * inverseSquareRoot(0.0f), 0.0f);
}

TEST(InverseSquareRoot, KeepsItsAccuracyAtTheEndsOfTheRangeOfAStep) {
  for (const float x : {0x1p-126f, 0x1p-63f, 0x1p-40f, 0x1p40f, 0x1p125f})
    EXPECT_LT(errorInUlp(inverseSquareRoot(x), 1 / std::sqrt(static_cast<double>(x))), 1.21) << x;
}

TEST(Reciprocal, IsWithinOneAndAHalfUlpForEveryMantissa) {
  double worst = 0;
  for (std::uint32_t bits = 0x3f800000u; bits < 0x40000000u; ++bits) {
    const float x = floatFromBits(bits);
    worst = std::max(worst, errorInUlp(reciprocal(x), 1 / static_cast<double>(x)));
  }
  EXPECT_LT(worst, 1.48) << "1.47 when the constants were chosen";
}

TEST(Canonical, RemovesMinusZeroAndWhatCouldMakeDenormals) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(canonical(-0.0f)), 0u);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(canonical(-0x1p-41f)), 0u);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(canonical(std::numeric_limits<float>::denorm_min())), 0u);
  EXPECT_EQ(canonical(0x1p-40f), 0x1p-40f);
  EXPECT_EQ(canonical(-3.5f), -3.5f);
}

TEST(Canonical, KeepsNotANumberSoThatItCanBeFound) {
  EXPECT_TRUE(std::isnan(canonical(std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace clothsim
