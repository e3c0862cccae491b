// The normals pass against surfaces whose normals are known.
#include <cmath>
#include <functional>

#include "gl/gl_test.h"
#include "render/cloth_mesh.h"
#include "solver/state.h"

namespace clothsim {
namespace {

using Surface = std::function<Vec3d(double u, double v)>;  // u and v from 0 to 1

Scene sheets(int count, int columns, int rows) {
  Scene scene;
  scene.cloths.resize(static_cast<std::size_t>(count));
  for (ClothSettings& settings : scene.cloths) {
    settings.numWidthPoints = columns;
    settings.numHeightPoints = rows;
  }
  return scene;
}

// The normals of a single sheet laid over a surface, row by row.
std::vector<glm::vec4> normalsOf(const Cloth& cloth, const Surface& surface) {
  std::vector<Particle4> positions(cloth.particleCount());
  for (const Grid& grid : cloth.grids()) {
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const Vec3f p = surface(static_cast<double>(column) / (grid.columns - 1),
                                static_cast<double>(row) / (grid.rows - 1))
                            .cast<float>();
        positions[grid.particle(column, row)] = {p.x, p.y, p.z, 1};
      }
    }
  }
  const gl::Buffer<Particle4> buffer("positions", positions);
  ClothMesh mesh(cloth);
  const gl::Program pass = gl::Program::makeCompute("render/normals.comp");
  mesh.computeNormals(pass, buffer.name());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return mesh.normals().download();
}

double angle(glm::vec4 normal, glm::dvec3 expected) {
  const glm::dvec3 n(normal);
  return std::atan2(glm::length(glm::cross(n, expected)), glm::dot(n, expected));
}

using NormalsTest = GlTest;

TEST_F(NormalsTest, OfAFlatSheetPointUpEverywhereAtBordersAndCornersToo) {
  const Cloth cloth(sheets(1, 13, 9));
  for (const glm::vec4 normal : normalsOf(cloth, [](double u, double v) { return Vec3d{u, 0.3, v}; })) {
    EXPECT_NEAR(angle(normal, {0, 1, 0}), 0, 1e-6);
    EXPECT_NEAR(normal.w, 0, 1e-6) << "a flat sheet has no hollows";
  }
}

TEST_F(NormalsTest, FollowAWaveToTheSecondOrderOfItsSpacing) {
  constexpr double height = 0.05, k = 12;
  const Surface wave = [](double u, double v) {
    return Vec3d{u, height * std::sin(k * u) * std::cos(k * v), v};
  };
  const auto largestError = [&](int points) {
    const Cloth cloth(sheets(1, points, points));
    const std::vector<glm::vec4> normals = normalsOf(cloth, wave);
    double largest = 0;
    for (int row = 1; row + 1 < points; ++row) {
      for (int column = 1; column + 1 < points; ++column) {
        const double u = static_cast<double>(column) / (points - 1),
                     v = static_cast<double>(row) / (points - 1);
        const glm::dvec3 expected{-height * k * std::cos(k * u) * std::cos(k * v), 1,
                                  height * k * std::sin(k * u) * std::sin(k * v)};
        largest =
            std::max(largest, angle(normals[static_cast<std::size_t>(row * points + column)], expected));
      }
    }
    return largest;
  };
  const double coarse = largestError(41), fine = largestError(81);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, coarse / 3) << "halving the spacing should divide the error by four";
}

TEST_F(NormalsTest, OfUnitLengthEvenWhereTheSheetIsCrushedToAPoint) {
  const Cloth cloth(sheets(1, 8, 8));
  for (const glm::vec4 normal : normalsOf(cloth, [](double, double) { return Vec3d{0.5, 0.5, 0.5}; })) {
    EXPECT_NEAR(glm::length(glm::vec3(normal)), 1, 1e-6);
  }
}

TEST_F(NormalsTest, OfEverySheetOfASceneAreComputed) {
  const Cloth cloth(sheets(3, 5, 7));
  const std::vector<glm::vec4> normals = normalsOf(cloth, [](double u, double v) {
    return Vec3d{u, 2 * u, v};
  });
  ASSERT_EQ(normals.size(), 3u * 5u * 7u);
  for (const glm::vec4 normal : normals) EXPECT_NEAR(angle(normal, {-2, 1, 0}), 0, 1e-6);
}

TEST_F(NormalsTest, TellTheHollowOfAFoldFromItsRidge) {
  constexpr int points = 65;
  const Cloth cloth(sheets(1, points, points));
  const std::vector<glm::vec4> normals = normalsOf(cloth, [](double u, double v) {
    return Vec3d{u, 0.05 * std::cos(4 * std::acos(-1.0) * u), v};
  });
  const auto hollowAt = [&](int column) { return normals[static_cast<std::size_t>(32 * points + column)].w; };
  EXPECT_GT(hollowAt(16), 0.02) << "the bottom of the wave, seen from its front";
  EXPECT_LT(hollowAt(32), -0.02) << "its top";
}

}  // namespace
}  // namespace clothsim
