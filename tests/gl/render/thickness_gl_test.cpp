// Cloth that is drawn as thick as it is, against geometry.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "gl/render/reference_picture.h"
#include "render/cloth_rim.h"

namespace clothsim {
namespace {

using Shape = std::function<glm::dvec3(double u, double v)>;  // u and v from 0 to 1
using ThicknessTest = GlTest;

constexpr int SIZE = 240;  // of the square pictures [pixels]
constexpr double THICKNESS = 0.1, DISTANCE = 50, DEGREES = 1.6;
const double PIXELS = SIZE / (2 * DISTANCE * std::tan(DEGREES * std::numbers::pi / 360));  // a metre

// Dark cloth on white, seen from the direction `from`, next to without perspective.
Scene sheetFrom(Vec3d from, int points = 17) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = points;
  scene.render.shader = "diffuse";
  scene.render.color = scene.render.backColor = {0.05, 0.05, 0.05};
  scene.render.background = "plain";
  scene.render.backgroundColor = {1, 1, 1};
  scene.render.ground = false;
  scene.render.thickness = THICKNESS;
  scene.camera.fov = DEGREES;
  scene.camera.position = DISTANCE * from;
  scene.camera.target = Vec3d{0, 0, 0};
  return scene;
}

Image drawn(const Scene& scene, const Shape& shape, RenderOptions options = {.thick = true}) {
  const Cloth cloth(scene);
  const Piece& piece = cloth.pieces()[0];
  std::vector<glm::vec4> places(cloth.particleCount());
  for (int row = 0; row < piece.rows; ++row)
    for (int column = 0; column < piece.columns; ++column)
      places[piece.particle(column, row)] =
          glm::vec4(shape(double(column) / (piece.columns - 1), double(row) / (piece.rows - 1)), 1);
  const gl::Buffer<glm::vec4> positions("positions", places);
  Renderer renderer(cloth, scene, options);
  return renderImage(renderer, positions.name(), Camera(scene, cloth), 0, SIZE, SIZE);
}

// How much of a pixel is cloth, roughly.
double coverAt(const Image& image, int x, int y) {
  const auto [r, g, b] = test::pixelAt(image, x, y);
  return std::clamp((230.0 - g) / 180, 0.0, 1.0);
}
double area(const Image& image) {  // [m^2]
  double sum = 0;
  for (int y = 0; y < SIZE; ++y)
    for (int x = 0; x < SIZE; ++x) sum += coverAt(image, x, y);
  return sum / (PIXELS * PIXELS);
}
// How high above the middle of the picture cloth reaches there [m].
double topAbove(const Image& image, int x) {
  double rows = 0;
  for (int y = 0; y < SIZE / 2; ++y) rows += coverAt(image, x, y);
  return rows / PIXELS;
}

glm::dvec3 onPlane(double u, double v) { return {u - 0.5, 0, v - 0.5}; }

// Half a cylinder around z, short enough to be seen along it; its front outside, or inside.
constexpr double BEND_RADIUS = 0.45;
glm::dvec3 onArch(double u, double v) {
  const double angle = std::numbers::pi * (1 - u);
  return {BEND_RADIUS * std::cos(angle), BEND_RADIUS * std::sin(angle), 0.3 * (v - 0.5)};
}
glm::dvec3 onArchFromInside(double u, double v) { return onArch(1 - u, v); }

TEST_F(ThicknessTest, GivesASheetSeenFromItsEdgeThatHeightAndRoundEnds) {
  Scene scene = sheetFrom({0, 0, 1});
  EXPECT_NEAR(area(drawn(scene, onPlane)), THICKNESS + std::numbers::pi * THICKNESS * THICKNESS / 4,
              0.05 * THICKNESS);
  scene.render.thickness = 0;
  EXPECT_LT(area(drawn(scene, onPlane)), 0.15 * THICKNESS) << "a sheet without thickness";
}

TEST_F(ThicknessTest, LiesHalfOnEachSideOfABend) {
  const double ring = std::numbers::pi * THICKNESS * (BEND_RADIUS + THICKNESS / 4);
  for (const Shape& shape : {Shape(onArch), Shape(onArchFromInside)}) {
    const Scene along = sheetFrom({0, 0, 1}), aside = sheetFrom({1, 0, 0});
    for (const RenderOptions& options :
         {RenderOptions{.thick = true}, RenderOptions{.subdivisions = 1, .flatness = 0.2, .thick = true}}) {
      EXPECT_NEAR(area(drawn(along, shape, options)), ring, 0.04 * ring);
      EXPECT_NEAR(topAbove(drawn(aside, shape, options), SIZE / 2), BEND_RADIUS + THICKNESS / 2, 1.2 / PIXELS)
          << "the silhouette is that of the outer side";
    }
  }
}

TEST_F(ThicknessTest, HasEdgesWhoseNormalsAreThoseOfATube) {
  Scene scene = sheetFrom({0, 0, 1});
  scene.render.shader = "normal";
  const Image image = drawn(scene, onPlane);
  for (const double up : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
    const int y = static_cast<int>(std::lround(SIZE / 2 - 0.5 - up * THICKNESS / 2 * PIXELS));
    const auto [r, g, b] = test::pixelAt(image, SIZE / 2, y);
    EXPECT_NEAR(r / 127.5 - 1, 0, 0.05) << up;
    EXPECT_NEAR(g / 127.5 - 1, up, 0.12) << up;
    EXPECT_NEAR(b / 127.5 - 1, std::sqrt(1 - up * up), 0.12) << up;
  }
}

TEST_F(ThicknessTest, IsNotThereInDraft) {
  Scene scene = sheetFrom({0.5, 0.6, 0.6});
  const Image draft = drawn(scene, onArch, {});
  EXPECT_GT(test::meanDifference(drawn(scene, onArch), draft), 0.5);
  scene.render.thickness = 0;
  EXPECT_EQ(drawn(scene, onArch).rgb, draft.rgb);
  EXPECT_FALSE(withQuality({}, Quality::draft, true).thick);
  EXPECT_TRUE(withQuality({}, Quality::normal, true).thick);
}

// A standing sheet under light from straight above: only its upper edge is in the light's way.
TEST_F(ThicknessTest, ThrowsAShadow) {
  Scene scene = sheetFrom({0, 1, 1});
  scene.render.color = scene.render.backColor = {1, 1, 1};
  scene.render.backgroundColor = {0, 0, 0};
  scene.render.light = Vec3d{0, 1, 0};
  scene.colliders.emplace_back(Plane{});
  const Shape standing = [](double u, double v) { return glm::dvec3{u - 0.5, 0.5 - 0.3 * v, 0}; };
  const auto onFloor = [&](double thickness) {
    scene.render.thickness = thickness;
    return test::pixelAt(drawn(scene, standing), SIZE / 2, SIZE / 2)[1];
  };
  EXPECT_LT(onFloor(THICKNESS), 0.95 * onFloor(0));
}

TEST_F(ThicknessTest, IsThatOfTheClothUpToHalfADistanceOfPoints) {
  Scene scene;
  scene.cloths.resize(3);
  for (ClothSettings& cloth : scene.cloths) cloth.numWidthPoints = cloth.numHeightPoints = 11;
  scene.cloths[0].thickness = 0.02;
  scene.cloths[1].thickness = 0.09;
  scene.cloths[2].material = Material{.thickness = 0.001};
  const Cloth cloth(scene);
  EXPECT_EQ(drawnThickness(scene, cloth), (std::vector<float>{0.02f, 0.05f, 0.001f}));
  scene.render.thickness = 0.3;
  EXPECT_EQ(drawnThickness(scene, cloth), (std::vector<float>{0.3f, 0.3f, 0.3f}));
}

std::set<std::array<std::uint32_t, 3>> pointsOf(const std::vector<BorderCorner>& border) {
  std::set<std::array<std::uint32_t, 3>> points;
  for (const BorderCorner& corner : border) {
    EXPECT_EQ(border[corner.next].here, corner.after);
    EXPECT_EQ(border[corner.next].before, corner.here);
    points.insert({corner.before, corner.here, corner.after});
  }
  return points;
}

TEST_F(ThicknessTest, FindsTheBordersOfTrianglesThatGridsHave) {
  for (const Orientation orientation : {Orientation::horizontal, Orientation::vertical}) {
    Scene scene;
    scene.cloths[0].numWidthPoints = 5;
    scene.cloths[0].numHeightPoints = 4;
    scene.cloths[0].orientation = orientation;
    const Cloth cloth(scene);
    std::vector<std::array<std::uint32_t, 3>> triangles = cloth.triangles();
    const std::vector<BorderCorner> border = borderOf(TriangleSides(triangles));
    EXPECT_EQ(border.size(), 14u);
    EXPECT_EQ(pointsOf(border), pointsOf(borderOfGrid(cloth.pieces()[0])));
    // Without a cell in the middle there is a second border of four corners.
    triangles.erase(triangles.begin() + 10, triangles.begin() + 12);
    EXPECT_EQ(pointsOf(borderOf(TriangleSides(triangles))).size(), 18u);
  }
}

TEST(BrokenThickness, IsSeenInThePictures) {
  for (const auto& [file, from, to] :
       {std::array{"render/rim.comp", "radius * radial", "0.5 * radius * radial"},
        std::array{"render/cloth_point.glsl", "frame.thickness * piece", "-frame.thickness * piece"}}) {
    const test::ResourceCopy resources;
    ASSERT_TRUE(resources.change(file, from, to));
    const test::CommandResult result = resources.runTests("ThicknessTest.*Edge*:ThicknessTest.LiesHalf*");
    EXPECT_NE(result.output.find("FAILED  ] ThicknessTest"), std::string::npos) << file << result.output;
  }
}

}  // namespace
}  // namespace clothsim
