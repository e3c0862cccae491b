// The picture: against a stored one with a tolerance that broken shading exceeds, and rule by rule.
#include "render/programs.h"
#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/error.h"
#include "gl/framebuffer.h"
#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "render/shading_models.h"
#include "solver/solver.h"

namespace clothsim {
namespace {

using test::drapeScene;
using test::drawDrape;
using test::meanDifference;
using test::pixelAt;

using test::TOLERANCE;

using RendererTest = GlTest;

TEST_F(RendererTest, DrawsTheDrapeAsInTheStoredPicture) {
  EXPECT_LT(test::differenceFromReference("drape", drawDrape(drapeScene())), TOLERANCE);
}

// Runs the test above with one shader changed.
class BrokenShaderTest : public ::testing::Test {
 protected:
  static void expectSeen(const std::string& file, const std::string& from, const std::string& to) {
    const test::ResourceCopy resources;
    ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
    const test::CommandResult result = resources.runTests("RendererTest.DrawsTheDrapeAsInTheStoredPicture");
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_NE(result.output.find("Expected: (test::differenceFromReference"), std::string::npos)
        << "another failure: " << result.output;
  }
};

TEST_F(BrokenShaderTest, AFlippedNormalLeavesTheTolerance) {
  expectSeen("render/normals.comp", "sum / area", "-sum / area");
}
TEST_F(BrokenShaderTest, AMissingShadowOnTheFloorLeavesTheTolerance) {
  expectSeen("render/plane.frag", "texture(floorShadow, shadowPlace.xy).r", "1.0");
}
TEST_F(BrokenShaderTest, AMissingBackSideLeavesTheTolerance) {
  expectSeen("render/phong.frag", "frame.clothFront.rgb : frame.clothBack.rgb",
             "frame.clothBack.rgb : frame.clothFront.rgb");
}
TEST_F(BrokenShaderTest, AMissingConversionToSrgbLeavesTheTolerance) {
  expectSeen("render/resolve.frag", "srgbEncoded(clamp(", "(clamp(");
}

TEST_F(RendererTest, ShadowsDarkenTheSceneAndNothingGetsBrighterByThem) {
  RenderOptions without;
  without.shadows = false;
  const Image lit = drawDrape(drapeScene(), without), shadowed = drawDrape(drapeScene());
  EXPECT_GT(meanDifference(lit, shadowed), 2 * TOLERANCE);
  int brighter = 0;
  for (std::size_t i = 0; i < lit.rgb.size(); ++i) brighter += shadowed.rgb[i] > lit.rgb[i] + 2 ? 1 : 0;
  EXPECT_EQ(brighter, 0);
}

TEST_F(RendererTest, DrawsTheSamePictureTwice) {
  const test::Drape drape(drapeScene());
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  Renderer renderer(drape.cloth, drape.scene, {});
  const Camera camera(drape.scene, drape.cloth);
  const Image first = renderImage(renderer, positions.name(), camera, 0, 96, 64);
  const Image other = renderImage(renderer, positions.name(), camera, 0, 200, 100);
  EXPECT_EQ(other.rgb.size(), 3u * 200u * 100u);
  EXPECT_EQ(renderImage(renderer, positions.name(), camera, 0, 96, 64).rgb, first.rgb);
}

// The floor lies below what is in a scene at its start; a camera near it was under the floor then.
TEST_F(RendererTest, LeavesTheFloorWhereItIsWhenASolidIsLifted) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 5;
  scene.cloths[0].width = scene.cloths[0].height = 0.4;
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].position = {-0.5, 1, 0};
  scene.cloths[0].pinned = {GridSide::top};
  Sphere ball;
  ball.origin = {0.4, 0.2, 0};
  ball.radius = 0.2;
  scene.colliders.emplace_back(ball);
  scene.camera.position = Vec3d{0, 0.4, 2.6};
  scene.camera.target = Vec3d{0, 0.3, 0};
  const Cloth cloth(scene);
  const gl::Buffer<Particle4> positions("positions", stateAtRest(cloth).positions);
  Renderer renderer(cloth, scene, {});
  const Camera camera(scene, cloth);
  const auto corner = [&] {
    return pixelAt(renderImage(renderer, positions.name(), camera, 0, 96, 64), 2, 62);
  };
  const std::array<int, 3> before = corner();
  std::get<Sphere>(scene.colliders[0]).origin.y = 0.9;
  renderer.configure(scene);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(corner()[c], before[c], 8);
}

// A sheet that fills the picture, seen from one side or the other.
std::array<int, 3> middleOfSheetSeenFrom(double height) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 8;
  scene.render.color = {1, 0, 0};
  scene.render.backColor = {0, 0, 1};
  scene.render.ground = false;
  scene.camera.position = Vec3d{0.5, 1 + height, 0.51};
  scene.camera.target = Vec3d{0.5, 1, 0.5};
  const Cloth cloth(scene);
  const gl::Buffer<Particle4> positions("positions", initialState(cloth, scene).positions);
  Renderer renderer(cloth, scene, {});
  return pixelAt(renderImage(renderer, positions.name(), Camera(scene, cloth), 0, 32, 32), 16, 16);
}

TEST_F(RendererTest, ClothHasItsFrontColourAboveAndItsBackColourBelow) {
  const std::array<int, 3> above = middleOfSheetSeenFrom(0.6), below = middleOfSheetSeenFrom(-0.6);
  EXPECT_GT(above[0], 2 * above[2]);
  EXPECT_GT(below[2], 2 * below[0]);
}

TEST_F(RendererTest, TheTopRowOfAnImageIsTheTopOfThePicture) {
  Scene scene = drapeScene();
  scene.camera.position = Vec3d{0.5, 0.3, 3};
  scene.camera.target = Vec3d{0.5, -0.2, 0.5};  // the cloth is in the upper half
  const Image image = drawDrape(scene);
  const auto reddish = [&](int y) {
    int count = 0;
    for (int x = 0; x < image.width; ++x)
      count += pixelAt(image, x, y)[0] > 2 * pixelAt(image, x, y)[1] ? 1 : 0;
    return count;
  };
  int upper = 0, lower = 0;
  for (int y = 0; y < 32; ++y) {
    upper += reddish(y);
    lower += reddish(63 - y);
  }
  EXPECT_GT(upper, 4 * lower);
}

TEST_F(RendererTest, MultisamplingSmoothsEdges) {
  RenderOptions one;
  one.samples = 1;
  const Image smooth = drawDrape(drapeScene()), rough = drawDrape(drapeScene(), one);
  const double difference = meanDifference(smooth, rough);
  EXPECT_GT(difference, 0.05) << "one sample and four give the same picture";
  EXPECT_LT(difference, 3.0) << "one sample and four give different scenes";
}

// The height of an edge in each column of pixels, by how much of its pixels the sheet below it covers.
std::vector<double> heightsOfEdge(const Image& image) {
  const auto light = [&](int x, int y) {
    const double srgb = pixelAt(image, x, y)[1] / 255.0;
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
  };
  const double above = light(0, 0), below = light(0, image.height - 1);
  std::vector<double> heights;
  for (int x = 0; x < image.width; ++x) {
    double height = 0;
    for (int y = 0; y < image.height; ++y)
      height += std::round(50 * (light(x, y) - above) / (below - above)) / 50;
    heights.push_back(height);
  }
  return heights;
}

double farthestFromLine(std::span<const double> heights) {
  const auto count = static_cast<double>(heights.size());
  double mean = 0, slope = 0, squares = 0, farthest = 0;
  for (const double height : heights) mean += height / count;
  const auto fromMiddle = [&](std::size_t x) { return static_cast<double>(x) - 0.5 * (count - 1); };
  for (std::size_t x = 0; x < heights.size(); ++x) {
    slope += fromMiddle(x) * (heights[x] - mean);
    squares += fromMiddle(x) * fromMiddle(x);
  }
  for (std::size_t x = 0; x < heights.size(); ++x)
    farthest = std::max(farthest, std::abs(heights[x] - mean - slope / squares * fromMiddle(x)));
  return farthest;
}

// Without smoothing an edge lies up to half a pixel beside the straight line, and with what looked six pixels
// along it, 0.41.
TEST_F(RendererTest, ASlantedEdgeHasNoStepsWithOneSampleAPixel) {
  Scene scene = drapeScene();
  scene.colliders.clear();
  scene.render.shader = "normal";  // one colour all over a flat sheet
  scene.render.background = "plain";
  scene.render.backgroundColor = {0.95, 0.95, 0.95};
  scene.camera.position = Vec3d{0, 50, 10};
  scene.camera.target = Vec3d{0, 50, 0};
  RenderOptions one;
  one.samples = 1;
  for (const double slope : {0.045, 0.11, 0.3, 0.7}) {
    test::Drape sheet(scene);
    for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
      const Vec3d rest = sheet.cloth.positions()[i];
      const double x = 40 * (rest.x - 0.5);
      sheet.positions[i] = {static_cast<float>(x), static_cast<float>(50 + slope * x - 40 * rest.z), 0, 1};
    }
    const gl::Buffer<Particle4> positions("positions", sheet.positions);
    Renderer renderer(sheet.cloth, sheet.scene, one);
    const Image image =
        renderImage(renderer, positions.name(), Camera(sheet.scene, sheet.cloth), 0, 192, 160);
    const std::vector<double> heights = heightsOfEdge(image);
    // The ends of an edge at the border of the picture are not seen.
    EXPECT_LT(farthestFromLine(std::span(heights).subspan(30, 132)), 0.25)
        << "pixels, at a slope of " << slope;
  }
}

TEST_F(RendererTest, CoarseSpheresHaveCorners) {
  Scene scene = drapeScene();
  scene.cloths[0].position = {50, 0, 0};  // out of the picture
  const Cloth cloth(scene);
  const gl::Buffer<Particle4> positions("positions", initialState(cloth, scene).positions);
  const Camera camera(scene, cloth);
  const auto draw = [&](int around, int down) {
    RenderOptions options;
    options.sphereSegmentsAround = around;
    options.sphereSegmentsDown = down;
    Renderer renderer(cloth, scene, options);
    return renderImage(renderer, positions.name(), camera, 0, 96, 64);
  };
  EXPECT_GT(meanDifference(draw(4, 2), draw(64, 48)), 0.5);
  EXPECT_LT(meanDifference(draw(60, 40), draw(64, 48)), 0.2);
}

TEST_F(RendererTest, DrawsEveryPlaneAndTheFloorOnlyWhereThereIsNoHorizontalOne) {
  const auto floorPixel = [](const Scene& scene) { return pixelAt(drawDrape(scene), 20, 58); };
  Scene bare = drapeScene();
  bare.render.ground = false;
  const Scene grounded = drapeScene();
  EXPECT_NE(floorPixel(bare), floorPixel(grounded));
  Scene withPlane = bare;
  withPlane.colliders.emplace_back(Plane{});
  EXPECT_NE(floorPixel(bare), floorPixel(withPlane));
  Scene both = withPlane;
  both.render.ground = true;
  EXPECT_EQ(floorPixel(both), floorPixel(withPlane)) << "the ground is drawn although the scene has a floor";
}

TEST_F(RendererTest, ClothThatLiesExactlyInAPlaneIsSeen) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 33;
  scene.camera.position = Vec3d{1.6, 1.5, 2.2};
  scene.camera.target = Vec3d{0.5, 0.3, 0.5};
  const auto redPixels = [](const Scene& drawn) {
    const Cloth cloth(drawn);
    std::vector<Particle4> places;
    for (const Vec3d& rest : cloth.positions())
      places.push_back({static_cast<float>(rest.x), static_cast<float>(0.3 * rest.x + 0.1 * rest.z),
                        static_cast<float>(rest.z), 1});
    const gl::Buffer<Particle4> positions("positions", places);
    Renderer renderer(cloth, drawn, {});
    const Image image = renderImage(renderer, positions.name(), Camera(drawn, cloth), 0, 200, 120);
    int red = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) red += image.rgb[i] > 2 * image.rgb[i + 1] ? 1 : 0;
    return red;
  };
  const int alone = redPixels(scene);
  Plane plane;
  plane.point = {0, 0, 0};
  plane.normal = {-0.3, 1, -0.1};
  scene.colliders.emplace_back(plane);
  EXPECT_GT(alone, 2000);
  EXPECT_NEAR(redPixels(scene), alone, 0.01 * alone);
}

TEST_F(RendererTest, AnEditedSceneIsDrawnAnew) {
  const test::Drape drape(drapeScene());
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  const Camera camera(drape.scene, drape.cloth);
  Renderer renderer(drape.cloth, drape.scene, {});
  Scene edited = drape.scene;
  edited.render.color = {0.1, 0.5, 0.2};
  std::get<Sphere>(edited.colliders[0]).origin = {0.9, 0.3, 0.9};
  renderer.configure(edited);
  const Image image = renderImage(renderer, positions.name(), camera, 0, 96, 64);
  EXPECT_LT(meanDifference(image, drawDrape(edited)), 0.01);
  EXPECT_GT(meanDifference(image, drawDrape(drape.scene)), 2 * TOLERANCE);
}

TEST_F(RendererTest, SeveralSheetsAreDrawn) {
  Scene scene = drapeScene();
  scene.cloths.push_back(scene.cloths[0]);  // the second lies in the same place: the picture is the same
  EXPECT_LT(meanDifference(drawDrape(scene), drawDrape(drapeScene())), 0.2);
  const test::Drape two(scene);
  std::vector<Particle4> apart = two.positions;
  for (std::size_t i = apart.size() / 2; i < apart.size(); ++i) apart[i].x += 0.6f;
  const gl::Buffer<Particle4> positions("positions", apart);
  Renderer renderer(two.cloth, scene, {});
  const Image image = renderImage(renderer, positions.name(), Camera(scene, two.cloth), 0, 96, 64);
  EXPECT_GT(meanDifference(image, drawDrape(scene)), 2 * TOLERANCE);
}

TEST_F(RendererTest, ASheetOfASingleRowOfPointsHasNoTrianglesAndIsNoError) {
  Scene scene;
  scene.cloths[0].numHeightPoints = 1;
  const Cloth cloth(scene);
  const gl::Buffer<Particle4> positions("positions", initialState(cloth, scene).positions);
  Renderer renderer(cloth, scene, {});
  EXPECT_EQ(renderImage(renderer, positions.name(), Camera(scene, cloth), 0, 16, 16).rgb.size(),
            3u * 16u * 16u);
}

TEST_F(RendererTest, AnUnknownShadingModelIsASceneErrorThatListsTheKnownOnes) {
  Scene scene = drapeScene();
  scene.render.shader = "glitter";
  const Cloth cloth(scene);
  try {
    const Renderer renderer(cloth, scene, {});
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("glitter"), std::string::npos) << error.what();
    for (const std::string& name : shadingModelNames()) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST_F(RendererTest, EveryShadingModelCompiles) {
  for (const std::string& name : shadingModelNames()) {
    RenderSettings settings;
    settings.shader = name;
    const ShadingModel model = shadingModelOf(settings);
    RenderPrograms programs(model, settings, 1);
    for (const ClothLight light : {ClothLight::atPixels, ClothLight::exposed})
      EXPECT_NE(programs.cloth(model, light).name(), 0u) << name;
  }
}

}  // namespace
}  // namespace clothsim
