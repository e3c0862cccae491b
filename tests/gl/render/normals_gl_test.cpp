// The normals pass against surfaces whose normals are known.
#include <cmath>
#include <functional>

#include "gl/gl_test.h"
#include "render/cloth_mesh.h"
#include "solver/state.h"

namespace clothsim {
namespace {

using ParametricSurface = std::function<Vec3d(double u, double v)>;  // u and v from 0 to 1

Scene sheets(int count, int columns, int rows) {
  Scene scene;
  scene.cloths.resize(static_cast<std::size_t>(count));
  for (ClothSettings& settings : scene.cloths) {
    settings.numWidthPoints = columns;
    settings.numHeightPoints = rows;
  }
  return scene;
}

struct Measured {
  std::vector<glm::vec4> normals, tangents;
};

// Of sheets laid over a surface, row by row.
Measured measure(const Cloth& cloth, const ParametricSurface& surface, const Cuts& cuts = {},
                 bool strain = false) {
  std::vector<Particle4> positions(cloth.particleCount());
  for (const Piece& piece : cloth.pieces()) {
    for (int row = 0; row < piece.rows; ++row) {
      for (int column = 0; column < piece.columns; ++column) {
        const Vec3f p = surface(static_cast<double>(column) / (piece.columns - 1),
                                static_cast<double>(row) / (piece.rows - 1))
                            .cast<float>();
        positions[piece.particle(column, row)] = {p.x, p.y, p.z, 1};
      }
    }
  }
  const gl::Buffer<Particle4> buffer("positions", positions);
  ClothMesh mesh(cloth);
  mesh.setCuts(cloth, cuts);
  mesh.keepRestPositions(cloth);
  gl::Defines defines;
  if (!cuts.empty()) defines.emplace_back("CUTS", "");
  if (strain) defines.emplace_back("STRAIN", "");
  mesh.computeNormals({gl::Program::makeCompute("render/normals.comp", defines)}, buffer.name());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return {mesh.normals().download(), mesh.tangents().download()};
}

std::vector<glm::vec4> normalsOf(const Cloth& cloth, const ParametricSurface& surface) {
  return measure(cloth, surface).normals;
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
  const ParametricSurface wave = [](double u, double v) {
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

TEST_F(NormalsTest, TangentsLieInTheSurfaceAlongU) {
  const Cloth cloth(sheets(1, 41, 33));
  const ParametricSurface wave = [](double u, double v) {
    return Vec3d{u + 0.2 * v, 0.05 * std::sin(6 * u) * std::cos(5 * v), v};
  };
  const Measured measured = measure(cloth, wave);
  const Piece& piece = cloth.pieces()[0];
  for (int row = 0; row < piece.rows; ++row) {
    for (int column = 1; column + 1 < piece.columns; ++column) {
      const double u = static_cast<double>(column) / (piece.columns - 1);
      const double v = static_cast<double>(row) / (piece.rows - 1);
      const std::uint32_t particle = piece.particle(column, row);
      const glm::dvec3 expected =
          glm::normalize(glm::dvec3(1, 0.05 * 6 * std::cos(6 * u) * std::cos(5 * v), 0));
      EXPECT_LT(angle(measured.tangents[particle], expected), 0.02);
      EXPECT_NEAR(glm::dot(glm::vec3(measured.tangents[particle]), glm::vec3(measured.normals[particle])), 0,
                  1e-5);
    }
  }
}

// Two flat halves that meet at an angle between columns 4 and 5: cut apart there, each has its own normal up
// to the edge.
TEST_F(NormalsTest, NextToACutAreThoseOfTheirOwnSide) {
  const Cloth cloth(sheets(1, 10, 7));
  const ParametricSurface roof = [](double u, double v) {
    return u < 0.5 ? Vec3d{u, u, v} : Vec3d{u + 0.1, 1 - u, v};
  };
  Cuts cuts;
  ASSERT_TRUE(cutAlong(cuts, cloth, 0, {4.5, -1}, {4.5, 8}));
  const Measured whole = measure(cloth, roof), cut = measure(cloth, roof, cuts);
  const Piece& piece = cloth.pieces()[0];
  const double s = std::sqrt(0.5);
  for (int row = 0; row < piece.rows; ++row) {
    EXPECT_NEAR(angle(cut.normals[piece.particle(4, row)], {-s, s, 0}), 0, 1e-5);
    EXPECT_NEAR(angle(cut.normals[piece.particle(5, row)], {s, s, 0}), 0, 1e-5);
    EXPECT_NEAR(angle(cut.tangents[piece.particle(4, row)], {s, s, 0}), 0, 1e-5);
    EXPECT_GT(angle(whole.normals[piece.particle(4, row)], {-s, s, 0}), 0.2);
  }
}

TEST_F(NormalsTest, BesideThemStrainIsTheLargestOfSidesAndDiagonalsThatAreLeft) {
  const Cloth cloth(sheets(1, 11, 11));  // 1 m x 1 m
  const ParametricSurface stretched = [](double u, double v) { return Vec3d{1.08 * u, 1, 0.97 * v}; };
  for (const glm::vec4 tangent : measure(cloth, stretched, {}, true).tangents)
    EXPECT_NEAR(tangent.w, 0.08, 1e-5);
  const ParametricSurface apart = [](double u, double v) { return Vec3d{u + (u > 0.45 ? 0.5 : 0), 1, v}; };
  Cuts cuts;
  cutAlong(cuts, cloth, 0, {4.5, -1}, {4.5, 12});
  EXPECT_GT(measure(cloth, apart, {}, true).tangents[4].w, 4);
  EXPECT_NEAR(measure(cloth, apart, cuts, true).tangents[4].w, 0, 1e-5);
}

}  // namespace
}  // namespace clothsim
