// The smooth surface of meshes and of cut grids, against surfaces whose shape is known.
#include "render/patches.h"

#include <algorithm>
#include <cmath>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "gl/render/reference_picture.h"
#include "render/smooth_surface.h"
#include "support/mesh_sheet.h"

namespace clothsim {
namespace {

using PatchesTest = GlTest;

constexpr double RADIUS = 0.25, EDGE = 0.1;

// Equilateral triangles, somewhat out of order, laid around a cylinder along y.
struct Rolled {
  Scene scene = test::meshScene({.columns = 9, .rows = 10, .edge = EDGE, .disorder = 0.1});
  Cloth cloth{scene};
  std::vector<glm::vec4> places;

  Rolled() {
    for (const Vec3d& p : cloth.positions()) {
      const double angle = (p.x - 0.4) / RADIUS;
      places.emplace_back(RADIUS * std::sin(angle), p.y - 0.4, RADIUS * std::cos(angle), 1);
    }
  }
};

struct Computed {
  std::vector<glm::vec4> points, normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Computed computed(const Cloth& cloth, const std::vector<glm::vec4>& places, std::uint32_t steps,
                  const Cuts& cuts = {}) {
  const gl::Buffer<glm::vec4> positions("positions", places);
  ClothMesh particles(cloth);
  particles.setCuts(cloth, cuts);
  gl::Defines defines;
  if (!cuts.empty()) defines.emplace_back("CUTS", "");
  const gl::Program grids = gl::Program::makeCompute("render/normals.comp", defines),
                    meshes = gl::Program::makeCompute("render/mesh_normals.comp");
  particles.computeNormals({grids, &meshes}, positions.name());
  const std::array all{steps};
  SmoothSurface surface(cloth, all, false, {}, cuts);
  surface.compute(SmoothPrograms(), positions.name(), particles);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return {surface.points().download(), surface.normals().download(), surface.triangles()};
}

TEST_F(PatchesTest, LieOnACylinderWhereTrianglesLieFarBelowIt) {
  const Rolled rolled;
  constexpr double belowTriangles = EDGE * EDGE / (8 * RADIUS);
  const Computed surface = computed(rolled.cloth, rolled.places, 4);
  double mean = 0, flat = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const glm::dvec3 p(surface.points[a]), q(surface.points[b]);
    for (const glm::dvec3& place : {p, (p + q) / 2.0}) {
      const double off = std::hypot(place.x, place.z) - RADIUS;
      mean += std::abs(off) / (2.0 * double(surface.triangles.size()));
      EXPECT_LT(std::abs(off), belowTriangles);
    }
  }
  const Computed rough = computed(rolled.cloth, rolled.places, 1);
  EXPECT_EQ(rough.triangles.size() * 16, surface.triangles.size());
  for (const auto& [a, b, c] : rough.triangles)
    flat += (RADIUS -
             std::hypot(rough.points[a].x + rough.points[b].x, rough.points[a].z + rough.points[b].z) / 2) /
            double(rough.triangles.size());
  EXPECT_LT(mean, flat / 4);
}

TEST_F(PatchesTest, HaveNoGapsBetweenThem) {
  const Rolled rolled;
  for (const std::uint32_t steps : {1u, 2u, 4u}) {
    const Patches patches = divideTriangles(rolled.cloth.triangles(), steps, 0, rolled.cloth.positions(),
                                            rolled.cloth.textureCoordinates());
    const TriangleSides sides(patches.triangles);
    std::size_t border = 0;
    for (std::uint32_t side = 0; side < sides.count(); ++side)
      border += sides.twin(side) == TriangleSides::NONE ? 1 : 0;
    EXPECT_EQ(border, steps * 2 * (8 + 9)) << "that of the mesh";
    // Euler: V - E + F of a disc.
    const std::size_t edges = (sides.count() + border) / 2;
    EXPECT_EQ(patches.points.size() + patches.triangles.size(), edges + 1);
    const std::vector<BorderCorner> around = borderOf(sides);
    ASSERT_EQ(patches.border.size(), around.size());
    for (const BorderCorner& corner : patches.border) {
      EXPECT_NE(sides.find(corner.here, corner.after), TriangleSides::NONE);
      EXPECT_EQ(patches.border[corner.next].before, corner.here);
    }
  }
}

// A half disc of them, whose middle lies on the border.
TEST_F(PatchesTest, GoAroundAPointWithAnyNumberOfTriangles) {
  constexpr std::uint32_t COUNT = 1500;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3d> rest{{0, 0, 0}};
  for (std::uint32_t i = 0; i <= COUNT; ++i) {
    rest.push_back({std::cos(M_PI * i / COUNT), std::sin(M_PI * i / COUNT), 0});
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  const std::vector<std::array<float, 2>> coordinates(rest.size());
  EXPECT_EQ(borderOf(TriangleSides(triangles)).size(), COUNT + 2);
  EXPECT_EQ(divideTriangles(triangles, 2, 0, rest, coordinates).border.size(), 2 * (COUNT + 2));
}

// Around point 0 one triangle looks the other way, so that no border goes on there.
TEST_F(PatchesTest, LeaveOutBordersThatBreakOff) {
  const std::vector<std::array<std::uint32_t, 3>> triangles{
      {0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 2, 4}, {0, 4, 3}};
  const std::vector<BorderCorner> corners = borderOf(TriangleSides(triangles));
  for (const BorderCorner& corner : corners) {
    ASSERT_LT(corner.next, corners.size());
    EXPECT_EQ(corners[corner.next].here, corner.after);
  }
}

// The triangles of one half have another part of the texture than those of the other.
TEST_F(PatchesTest, KeepToTheirPartOfTheTextureAtItsSeams) {
  const Rolled rolled;
  const auto triangles = rolled.cloth.triangles();
  TextureSeams seams;
  for (std::size_t t = triangles.size() / 2; t < triangles.size(); ++t)
    seams[triangles[t]] = {{{5, 5}, {5.5f, 5}, {5, 5.5f}}};
  constexpr std::uint32_t STEPS = 3;
  const Patches patches = divideTriangles(triangles, STEPS, 0, rolled.cloth.positions(),
                                          rolled.cloth.textureCoordinates(), seams);
  for (std::size_t t = 0; t < patches.triangles.size(); ++t) {
    const bool isBehind = t / (STEPS * STEPS) >= triangles.size() / 2;
    for (const std::uint32_t point : patches.triangles[t])
      EXPECT_EQ(patches.textureCoordinates[point][0] >= 5, isBehind) << t;
  }
  const Patches without =
      divideTriangles(triangles, STEPS, 0, rolled.cloth.positions(), rolled.cloth.textureCoordinates());
  EXPECT_GT(patches.points.size(), without.points.size());
  EXPECT_EQ(patches.border, without.border);
}

TEST_F(PatchesTest, FaceWhereTheirTrianglesDoAndKeepParticlesInPlace) {
  const Rolled rolled;
  const Computed surface = computed(rolled.cloth, rolled.places, 4);
  for (const auto& [a, b, c] : surface.triangles) {
    const glm::vec3 p(surface.points[a]), q(surface.points[b]), r(surface.points[c]);
    ASSERT_GT(glm::dot(glm::cross(q - p, r - p), glm::vec3(surface.normals[a])), 0);
  }
  for (const glm::vec4& place : rolled.places)
    EXPECT_TRUE(std::any_of(surface.points.begin(), surface.points.end(), [&](const glm::vec4& point) {
      return glm::distance(glm::vec3(point), glm::vec3(place)) < 1e-6f;
    }));
}

// A cut across a flat grid, by the farthest corner of its edge from the stroke, on one side of it [cells].
TEST_F(PatchesTest, OfACutHaveNoStepsOfCells) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 21;
  const Cloth cloth(scene);
  Cuts cuts;
  ASSERT_TRUE(cutAlong(cuts, cloth, 0, {3.3, 3.6}, {17.3, 17.6}));
  std::vector<glm::vec4> places;
  const Piece& piece = cloth.pieces()[0];
  for (int row = 0; row < piece.rows; ++row)
    for (int column = 0; column < piece.columns; ++column) places.emplace_back(column, row, 0, 1);
  const Computed surface = computed(cloth, places, 2, cuts);
  const TriangleSides sides(surface.triangles);
  double least = 1e9, most = -1e9, leastRough = 1e9, mostRough = -1e9;
  const auto alongTheMiddle = [](const glm::vec4& p) {
    return p.x + p.y > 14 && p.x + p.y < 28 && p.x - p.y < 4 && p.x - p.y > -0.3;
  };
  for (const BorderCorner& corner : borderOf(sides)) {
    const glm::vec4& point = surface.points[corner.here];
    if (!alongTheMiddle(point)) continue;
    least = std::min<double>(least, point.x - point.y);
    most = std::max<double>(most, point.x - point.y);
  }
  const auto rough = remainingTriangles(cloth, cuts);
  for (const BorderCorner& corner : borderOf(TriangleSides(rough))) {
    const glm::vec4& point = places[corner.here];
    if (!alongTheMiddle(point)) continue;
    leastRough = std::min<double>(leastRough, point.x - point.y);
    mostRough = std::max<double>(mostRough, point.x - point.y);
  }
  EXPECT_GE(mostRough - leastRough, 1) << leastRough << " " << mostRough;
  EXPECT_LT(most - least, 0.3 * (mostRough - leastRough));
}

// How uneven the upper edge of the cylinder is in a picture from the side [pixels].
double unevenness(int subdivisions) {
  Rolled rolled;
  rolled.scene.render.shader = "diffuse";
  rolled.scene.render.color = rolled.scene.render.backColor = {0.05, 0.05, 0.05};
  rolled.scene.render.background = "plain";
  rolled.scene.render.backgroundColor = {1, 1, 1};
  rolled.scene.render.ground = false;
  rolled.scene.camera.fov = 0.25;
  rolled.scene.camera.position = Vec3d{50, 0, 0.2};
  rolled.scene.camera.target = Vec3d{0, 0, 0.2};
  RenderOptions options;
  options.subdivisions = subdivisions;
  const gl::Buffer<glm::vec4> positions("positions", rolled.places);
  Renderer renderer(rolled.cloth, rolled.scene, options);
  const Image image =
      renderImage(renderer, positions.name(), Camera(rolled.scene, rolled.cloth), 0, 400, 400);
  double least = 1e9, most = 0;  // dark pixels from the middle of a row on, to where z is largest
  for (int y = 0; y < 400; ++y) {
    double dark = 0;
    for (int x = 0; x < 200; ++x) dark += std::clamp((220.0 - test::pixelAt(image, x, y)[1]) / 120, 0.0, 1.0);
    least = std::min(least, dark);
    most = std::max(most, dark);
  }
  return most - least;
}

TEST_F(PatchesTest, HaveNoPolygonalSilhouette) {
  const double rough = unevenness(0), smooth = unevenness(3);
  EXPECT_GT(rough, 5);
  EXPECT_LT(smooth, rough / 3);
}

TEST(BrokenPatches, AreSeenInThePicture) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change("render/patch_point.glsl", "SHARE = 0.5", "SHARE = 0.1"));
  const test::CommandResult result = resources.runTests("PatchesTest.*Silhouette:PatchesTest.*Cylinder*");
  EXPECT_NE(result.output.find("FAILED  ] PatchesTest.HaveNoPolygonalSilhouette"), std::string::npos)
      << result.output;
}

}  // namespace
}  // namespace clothsim
