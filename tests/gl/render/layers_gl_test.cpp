// Layers of cloth that touch, drawn smooth: what lies above is what is seen.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "gl/render/reference_picture.h"

namespace clothsim {
namespace {

using LayersTest = GlTest;
using Shape = std::function<glm::dvec3(double u, double v)>;  // u and v from 0 to 1

constexpr int PICTURE_SIZE = 240;                    // of the square pictures [pixels]
constexpr double CELL = 1.0 / 8, THICKNESS = 0.002;  // [m]
constexpr Vec3d ABOVE{0.7, 0.05, 0.05}, BELOW{0.05, 0.05, 0.7};

// Sheets of 9 x 9 particles as seen from above; of one sheet the front is of one colour, the back of the
// other.
Scene sheetsFromAbove(std::size_t count) {
  Scene scene;
  scene.cloths.resize(count);
  for (ClothSettings& cloth : scene.cloths) cloth.numWidthPoints = cloth.numHeightPoints = 9;
  scene.render.shader = "diffuse";
  scene.render.color = BELOW;
  scene.render.backColor = ABOVE;
  if (count == 2) {
    scene.cloths[0].render.color = scene.cloths[0].render.backColor = BELOW;
    scene.cloths[1].render.color = scene.cloths[1].render.backColor = ABOVE;
  }
  scene.render.background = "plain";
  scene.render.backgroundColor = {1, 1, 1};
  scene.render.ground = false;
  scene.camera.position = Vec3d{0.45, 3, 0.8};
  scene.camera.target = Vec3d{0.5, 0, 0.5};
  scene.camera.fov = 20;
  scene.solver.selfCollision = SelfCollision::contact;
  return scene;
}

std::vector<glm::vec4> placesOf(const Cloth& cloth, const std::vector<Shape>& shapes) {
  std::vector<glm::vec4> places(cloth.particleCount());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Piece& piece = cloth.pieces()[k];
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column)
        places[piece.particle(column, row)] =
            glm::vec4(shapes[k](double(column) / (piece.columns - 1), double(row) / (piece.rows - 1)), 1);
  }
  return places;
}

// By pixel: whether the upper layer is seen there, or the lower.
enum class Layer { none, above, below };
using Picture = std::vector<Layer>;

Picture pictureOf(const Scene& scene, const std::vector<Shape>& shapes, const RenderOptions& options,
                  const std::function<Cuts(const Cloth&)>& cuts) {
  const Cloth cloth(scene);
  const gl::Buffer<glm::vec4> positions("positions", placesOf(cloth, shapes));
  Renderer renderer(cloth, scene, options);
  if (cuts) renderer.setCuts(cuts(cloth));
  const Image image =
      renderImage(renderer, positions.name(), Camera(scene, cloth), 0, PICTURE_SIZE, PICTURE_SIZE);
  Picture picture;
  for (int y = 0; y < PICTURE_SIZE; ++y)
    for (int x = 0; x < PICTURE_SIZE; ++x) {
      const auto [r, g, b] = test::pixelAt(image, x, y);
      picture.push_back(g > 150 ? Layer::none : r > b ? Layer::above : Layer::below);
    }
  return picture;
}

// In how many pixels the lower layer is seen where triangles, which do not cross, show the upper one all
// around.
int wrongPixels(const Picture& picture, const Picture& triangles) {
  int count = 0;
  for (int y = 1; y + 1 < PICTURE_SIZE; ++y)
    for (int x = 1; x + 1 < PICTURE_SIZE; ++x) {
      const auto at = [&](int i, int j) { return std::size_t((y + j) * PICTURE_SIZE + x + i); };
      bool isAbove = picture[at(0, 0)] == Layer::below;
      for (int k = 0; k < 9; ++k) isAbove = isAbove && triangles[at(k % 3 - 1, k / 3 - 1)] == Layer::above;
      count += isAbove ? 1 : 0;
    }
  return count;
}

// How far a place is from the flat strip between the columns, or rows, 3 and 4.
double offStrip(double at) { return std::max(0.0, std::abs(at - 3.5 * CELL) - CELL / 2); }
glm::dvec3 ridge(double u, double v) { return {u, -1.2 * offStrip(u), v}; }
// Lies on the ridge, with its particles between those of that.
glm::dvec3 flatOnRidge(double u, double v) { return {u + 0.4 * CELL, THICKNESS, v - 0.3 * CELL}; }
// Meets the ridge from above, across it.
glm::dvec3 keelOnRidge(double u, double v) { return {u + 0.4 * CELL, THICKNESS + 0.6 * offStrip(v), v}; }

// A sheet that is folded around a tube, of which the halves lie on each other: like a drop, from the side.
glm::dvec3 foldedSheet(double u, double v) {
  const double from = 2 * (u + 0.02) - 1, along = std::abs(from);  // 0 at the fold
  const double open = 0.13 * std::sin(std::numbers::pi * std::min(along / 0.62, 1.0));
  const double half = along < 0.62 ? std::max(open, THICKNESS / 2) : THICKNESS / 2;
  return {0.9 - 0.8 * along, from < 0 ? -half : half, v};
}

const std::array<RenderOptions, 2> SMOOTH{RenderOptions{.samples = 1},
                                          RenderOptions{.samples = 1, .subdivisions = 1, .flatness = 0.25}};

// Where the smooth surface goes as it likes, the lower layer is seen through the upper one; where contact
// keeps layers apart, it is not.
void expectUpperLayer(std::size_t sheets, const std::vector<Shape>& shapes,
                      const std::function<Cuts(const Cloth&)>& cuts = {}) {
  Scene scene = sheetsFromAbove(sheets);
  RenderOptions rough = SMOOTH[0];
  rough.subdivisions = 0;
  const Picture triangles = pictureOf(scene, shapes, rough, cuts);
  ASSERT_GT(std::count(triangles.begin(), triangles.end(), Layer::above), PICTURE_SIZE * PICTURE_SIZE / 3);
  for (const RenderOptions& options : SMOOTH) {
    if (cuts && options.flatness > 0) continue;  // a lean surface is that of whole grids
    scene.solver.selfCollision = SelfCollision::off;
    const int free = wrongPixels(pictureOf(scene, shapes, options, cuts), triangles);
    scene.solver.selfCollision = SelfCollision::contact;
    const int kept = wrongPixels(pictureOf(scene, shapes, options, cuts), triangles);
    testing::Test::RecordProperty("without", std::to_string(free));
    EXPECT_GT(free, 150);
    EXPECT_EQ(kept, 0) << "of " << free << " where layers do not matter";
  }
}

TEST_F(LayersTest, AFlatSheetHidesTheRidgeItLiesOn) { expectUpperLayer(2, {ridge, flatOnRidge}); }
TEST_F(LayersTest, AKeelHidesTheRidgeItMeets) { expectUpperLayer(2, {ridge, keelOnRidge}); }
TEST_F(LayersTest, TheUpperHalfOfAFoldHidesTheLower) { expectUpperLayer(1, {foldedSheet}); }
TEST_F(LayersTest, CutSheetsHideEachOtherToo) {
  expectUpperLayer(2, {ridge, flatOnRidge}, [](const Cloth& cloth) {
    Cuts cuts;
    for (const std::size_t piece : {0u, 1u})
      static_cast<void>(cutAlong(cuts, cloth, piece, {6.5, 7.4}, {8.2, 7.6}));
    return cuts;
  });
}

TEST(BrokenLayers, LayersThatPassThroughEachOtherAreSeenInThePicture) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change("render/layer_shares.comp", "MOST_APPROACH = 0.5", "MOST_APPROACH = 50.0"));
  const test::CommandResult result = resources.runTests("LayersTest.AFlatSheetHidesTheRidgeItLiesOn");
  EXPECT_NE(result.output.find("FAILED  ] LayersTest"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace clothsim
