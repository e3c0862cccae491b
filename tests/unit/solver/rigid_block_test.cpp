// Blocks of the implicit integrator's coarse levels, inverted.
#include "solver/cpu/rigid_block.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace clothsim::cpu {
namespace {

using Matrix = std::array<std::array<float, 6>, 6>;

Matrix inverseOf(Matrix matrix) {
  std::array<float, 6> scales, pivots;
  sweepOut(6, 0, scales.data(), pivots.data(), [&](std::size_t j) { return matrix[j].data(); });
  for (auto& column : matrix)
    for (float& entry : column) entry = -entry;
  return matrix;
}

// v A v
double energyOf(const Matrix& a, const std::array<double, 6>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) sum += v[i] * static_cast<double>(a[i][j]) * v[j];
  return sum;
}

TEST(RigidBlock, IsInverted) {
  Matrix matrix;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      matrix[i][j] = (i == j ? 3.0f : 0.0f) + 1.0f / static_cast<float>(1 + i + j);
  const Matrix inverse = inverseOf(matrix);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k)
        sum += static_cast<double>(matrix[i][k]) * static_cast<double>(inverse[k][j]);
      EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-6);
    }
}

// Of the vertex next to the clamp of a fine strip of denim: but for rounding, it turns about one axis as it
// moves along another. What is left of the pivot of that axis is a part of 5e-6, of which it takes a
// hundredth, all rounding, from the next one. The inverse was not positive once, and the strip stood still.
TEST(RigidBlock, StaysPositiveWhereOneUnknownFollowsFromOthers) {
  const Matrix block{
      {{300.545593f, -1.1920929e-05f, 0.0251196977f, 1.89584061e-05f, 0.000229189318f, -0.226828381f},
       {-1.1920929e-05f, 6927.40137f, 1.54336154f, -0.00477000279f, 5.43808019e-05f, -5.50691038e-06f},
       {0.0251196958f, 1.54336154f, 246.691681f, 0.18618229f, -9.11864481e-06f, -7.33393244e-05f},
       {1.89584061e-05f, -0.00477000233f, 0.18618229f, 0.000140520628f, -6.88127688e-09f, -9.3032321e-07f},
       {0.000229189318f, 5.43808019e-05f, -9.11445386e-06f, -6.88127688e-09f, 3.98289012e-05f,
        -2.2917726e-07f},
       {-0.226828381f, -5.45149669e-06f, -7.3339208e-05f, -9.30323267e-07f, -2.2917726e-07f,
        0.00129097234f}}};
  const Matrix inverse = inverseOf(block);
  const std::array<double, 6> force{-8.34063e-10, -9.00327e-06, -0.00143105,
                                    -1.08004e-06, 2.18387e-07,  -7.53531e-12};
  EXPECT_GT(energyOf(inverse, force), 0);
  for (std::size_t k = 0; k < 6; ++k) {
    std::array<double, 6> unit{};
    unit[k] = 1;
    EXPECT_GE(energyOf(inverse, unit), 0) << k;
  }
}

}  // namespace
}  // namespace clothsim::cpu
