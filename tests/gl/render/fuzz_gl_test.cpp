// Fibres that stand off wool and velvet: what they look like, where they are seen, and what they are not to
// change.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "solver/solver.h"

namespace clothsim {
namespace {

constexpr int WIDTH = 160, HEIGHT = 120;

RenderOptions withFuzz() {
  RenderOptions options;
  options.thick = true;
  return options;
}

// Fibres that are long enough to be seen in a small picture.
Scene drapeOf(const std::string& weave, double fuzz = 0.03) {
  Scene scene = test::drapeScene();
  scene.camera.position = Vec3d{0.85, 0.95, 1.15};
  scene.camera.target = Vec3d{0.52, 0.55, 0.5};
  scene.render.shader = "fabric";
  scene.render.weave = weave;
  scene.render.gloss = 0;
  scene.render.threadSpacing = 0.004;
  scene.render.color = {0.47, 0.13, 0.12};
  scene.render.backColor = {0.35, 0.30, 0.25};
  scene.render.fuzz = fuzz;
  scene.render.smooth = false;
  return scene;
}

class FuzzPicture : public GlTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(FuzzPicture, IsTheStoredOne) {
  const Image image = test::drawDrape(drapeOf(GetParam()), withFuzz(), WIDTH, HEIGHT);
  EXPECT_LT(test::differenceFromReference("fuzz_" + GetParam(), image), test::TOLERANCE);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzPicture, ::testing::Values("twill", "velvet"),
                         [](const auto& weave) { return weave.param; });

using Fuzz = GlTest;

// Pixels outside of the cloth without fuzz, and inside of it, that fuzz changes.
std::pair<int, int> changedPixels(const std::string& weave) {
  Scene bare = drapeOf(weave, 0), fuzzy = drapeOf(weave);
  for (Scene* scene : {&bare, &fuzzy}) {
    scene->colliders.clear();
    scene->render.ground = false;
    scene->render.background = "plain";
  }
  const Image without = test::drawDrape(bare, withFuzz(), WIDTH, HEIGHT),
              with = test::drawDrape(fuzzy, withFuzz(), WIDTH, HEIGHT);
  const std::array<int, 3> background = test::pixelAt(without, 0, 0);
  std::pair<int, int> changed{0, 0};
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const auto a = test::pixelAt(without, x, y), b = test::pixelAt(with, x, y);
      const int difference = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
      if (difference > 12) ++(a == background ? changed.first : changed.second);
    }
  return changed;
}

TEST_F(Fuzz, StandsOffTheSilhouette) {
  const auto [outside, inside] = changedPixels("twill");
  EXPECT_GT(outside, 100);
  EXPECT_GT(inside, 100);
}

TEST_F(Fuzz, IsNotDrawnInDraftNorWhereItIsTooShortToBeSeen) {
  const Image bare = test::drawDrape(drapeOf("twill", 0), withFuzz(), WIDTH, HEIGHT);
  EXPECT_EQ(test::drawDrape(drapeOf("twill", 0.0005), withFuzz(), WIDTH, HEIGHT).rgb, bare.rgb);
  const Image draft = test::drawDrape(drapeOf("twill", 0), {}, WIDTH, HEIGHT);
  EXPECT_EQ(test::drawDrape(drapeOf("twill"), {}, WIDTH, HEIGHT).rgb, draft.rgb);
}

// A sheet seen at 60 degrees off its normal: what is too fine for pixels fades into its mean, of each weave.
TEST_F(Fuzz, LeavesNoMoire) {
  for (const char* weave : {"twill", "velvet"})
    for (const double length : {0.02, 0.05}) {
      Scene scene = drapeOf(weave, length);
      ClothSettings& cloth = scene.cloths[0];
      cloth.width = cloth.height = 40;
      cloth.numWidthPoints = cloth.numHeightPoints = 3;
      cloth.position = {-20, 0, -20};
      scene.colliders.clear();
      scene.render.ground = false;
      scene.render.threadSpacing = 1e-3;
      scene.render.thickness = 0;
      scene.camera.position = Vec3d{0, 2, 3.46};
      scene.camera.target = Vec3d{0, 0, 0};
      scene.camera.fov = 30;
      const Cloth made(scene);
      const gl::Buffer<Particle4> positions("positions", initialState(made, scene).positions);
      RenderOptions options = withFuzz();
      options.shadows = false;
      Renderer renderer(made, scene, options);
      const Image image = renderImage(renderer, positions.name(), Camera(scene, made), 0, WIDTH, HEIGHT);
      double mean = 0, squares = 0;
      const int n = WIDTH * 10;
      for (int y = HEIGHT / 2 - 5; y < HEIGHT / 2 + 5; ++y)
        for (int x = 0; x < WIDTH; ++x) {
          const double value = test::pixelAt(image, x, y)[0];
          mean += value / n;
          squares += value * value / n;
        }
      EXPECT_LT(std::sqrt(std::max(squares - mean * mean, 0.0)), 0.025 * mean)
          << weave << ", fibres of " << length << " m";
    }
}

void expectSeenInFuzz(const std::string& file, const std::string& from, const std::string& to,
                      const std::string& test) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  const test::CommandResult result = resources.runTests(test);
  EXPECT_NE(result.output.find("FAILED  ] " + test), std::string::npos) << result.output;
}

TEST(BrokenFuzz, ShellsThatDoNotStandOffAreSeen) {
  expectSeenInFuzz("render/fuzz.vert", "shell.x * frame.fuzz * side", "0.0", "Fuzz.StandsOffTheSilhouette");
}
TEST(BrokenFuzz, FibresInTheLightOfTheSideThatFacesTheEyeAreSeen) {
  expectSeenInFuzz("render/fuzz.frag", "side < 0.0 ? -1.0 : 1.0", "gl_FrontFacing ? 1.0 : -1.0",
                   "All/FuzzPicture.IsTheStoredOne/twill");
}
TEST(BrokenFuzz, APileThatIsAsLightBelowAsAboveIsSeen) {
  expectSeenInFuzz("render/fuzz.frag", "depth = mix(0.05, 1.5,", "depth = mix(1.0, 1.0,",
                   "All/FuzzPicture.IsTheStoredOne/velvet");
}

}  // namespace
}  // namespace clothsim
