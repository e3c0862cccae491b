// Weaves and knits of the model fabric: what each looks like, and that threads fade into their mean.
#include "render/weaves.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "render/exposure.h"
#include "solver/solver.h"

namespace clothsim {
namespace {

// Each with the gloss of what it is for; model_fabric.png has plain.
const std::vector<std::pair<std::string, double>> weaveLooks{
    {"denim", 0.15}, {"satin", 0.85}, {"jersey", 0.1}, {"velvet", 0}, {"none", 0.7}};

Scene drapeOfWeave(const std::string& weave, double gloss) {
  Scene scene = test::drapeScene();
  scene.camera.position = Vec3d{0.85, 0.95, 1.15};
  scene.camera.target = Vec3d{0.52, 0.55, 0.5};
  scene.render.shader = "fabric";
  scene.render.weave = weave;
  scene.render.gloss = gloss;
  scene.render.threadSpacing = 0.03;
  scene.render.color = {0.10, 0.16, 0.34};
  scene.render.backColor = {0.80, 0.76, 0.66};
  scene.render.smooth = false;
  return scene;
}

class WeavePicture : public GlTest, public ::testing::WithParamInterface<std::pair<std::string, double>> {};

TEST_P(WeavePicture, IsTheStoredOne) {
  const auto& [weave, gloss] = GetParam();
  const Image image = test::drawDrape(drapeOfWeave(weave, gloss), {}, 160, 120);
  EXPECT_LT(test::differenceFromReference("weave_" + weave, image), test::TOLERANCE);
}

INSTANTIATE_TEST_SUITE_P(All, WeavePicture, ::testing::ValuesIn(weaveLooks),
                         [](const auto& look) { return look.param.first; });

// With these resources the pictures of `broken`, and no others, must be other ones.
void expectOnlyBroken(const test::ResourceCopy& resources, const std::string& broken) {
  const test::CommandResult result = resources.runTests("All/WeavePicture.IsTheStoredOne/*");
  for (const auto& [weave, gloss] : weaveLooks) {
    const bool failed =
        result.output.find("FAILED  ] All/WeavePicture.IsTheStoredOne/" + weave) != std::string::npos;
    EXPECT_EQ(failed, weave == broken) << weave << "\n" << result.output;
  }
}

void expectSeenOn(const std::string& file, const std::string& from, const std::string& to,
                  const std::string& weave) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  expectOnlyBroken(resources, weave);
}

TEST(BrokenWeave, AWeftInTheColourOfTheWarpIsSeenOnDenim) {
  expectSeenOn("render/fabric_light.glsl", "mix(dye, frame.weft.rgb, frame.weft.w)", "dye", "denim");
}
TEST(BrokenWeave, GlossAlongTheWeftIsSeenOnSatin) {
  expectSeenOn("render/threads.glsl", "mix(shine.x, shine.y, warp)", "mix(shine.y, shine.x, warp)", "satin");
}
TEST(BrokenWeave, AFilmThatReflectsNothingIsSeen) {
  expectSeenOn("render/fabric_light.glsl", "FILM_REFLECTED = 0.04", "FILM_REFLECTED = 0.0", "none");
}
TEST(BrokenWeave, ThreadsInPlaceOfLoopsAreSeenOnJersey) {
  const test::ResourceCopy resources;
  const auto pictures = resources.root / "assets/textures";
  std::filesystem::copy_file(pictures / "weave_plain.png", pictures / "weave_jersey.png",
                             std::filesystem::copy_options::overwrite_existing);
  expectOnlyBroken(resources, "jersey");
}

// --- From close to far

constexpr int SWATCH_PIXELS = 80, MARGIN = 8;  // of the square pictures; around what is looked at [pixels]
constexpr double PIXEL = 0.5 / 128;            // in the middle of the sheet [m]
constexpr double EYE_DISTANCE = 0.8;           // [m]
constexpr int FEW_EXPOSURES = 16;              // enough for a mean

// A standing sheet that fills the picture, turned by `angle` [degrees] about the picture's horizontal middle,
// with threads of `pixels`. Relief is left out where means are compared: light on a slope is not linear in
// it.
Image swatchOf(const std::string& weave, double pixels, double angle = 0, double relief = 0, double gloss = 0,
               int exposures = FINAL_EXPOSURES) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.orientation = Orientation::vertical;
  cloth.width = cloth.height = 6;
  cloth.numWidthPoints = cloth.numHeightPoints = 3;
  cloth.position = {-3, -3, 0};
  const double turn = angle * std::numbers::pi / 180;
  scene.camera.target = Vec3d{0, 0, 0};
  scene.camera.position = Vec3d{0, EYE_DISTANCE * std::sin(turn), EYE_DISTANCE * std::cos(turn)};
  scene.camera.fov = 360 / std::numbers::pi * std::atan(0.5 * SWATCH_PIXELS * PIXEL / EYE_DISTANCE);
  scene.render.shader = "fabric";
  scene.render.weave = weave;
  scene.render.gloss = gloss;
  scene.render.normalStrength = relief;
  scene.render.threadSpacing = pixels * PIXEL;
  scene.render.color = {0.10, 0.16, 0.34};
  scene.render.backColor = {0.80, 0.76, 0.66};
  const double towards = angle > 90 ? -1 : 1;  // the side that is seen
  scene.render.light = relief > 0 ? Vec3d{1, 0, 1} : Vec3d{0, 0, towards};
  scene.render.thickness = 0;
  scene.render.ground = false;
  RenderOptions options = forExposures({}, exposures);
  options.shadows = false;
  const Cloth made(scene);
  const State state = initialState(made, scene);
  const gl::Buffer<Particle4> positions("positions", state.positions);
  Renderer renderer(made, scene, options);
  return renderImage(renderer, positions.name(), Camera(scene, made), 0, SWATCH_PIXELS, SWATCH_PIXELS,
                     exposures);
}

double linearLight(int value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Of linear light over a picture without its margin.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread spreadOf(const Image& image, std::size_t channel) {
  const int low = MARGIN, high = SWATCH_PIXELS - low, n = high - low;
  Spread spread;
  double squares = 0;
  for (int y = low; y < high; ++y)
    for (int x = low; x < high; ++x) {
      const double light = linearLight(test::pixelAt(image, x, y)[channel]);
      spread.mean += light / (n * n);
      squares += light * light / (n * n);
    }
  spread.deviation = std::sqrt(std::max(squares - spread.mean * spread.mean, 0.0));
  return spread;
}

// How far columns in the middle of the picture stand out from those half a period to their left and right, as
// a part of their light: the deviation.
double columnContrast(const Image& image, int period) {
  const auto column = [&](int x) {
    double sum = 0;
    for (int y = SWATCH_PIXELS / 2 - 3; y < SWATCH_PIXELS / 2 + 3; ++y)
      sum += linearLight(test::pixelAt(image, x, y)[1]);
    return sum;
  };
  double squares = 0, mean = 0;
  const int low = MARGIN, high = SWATCH_PIXELS - low;
  for (int x = low; x < high; ++x) {
    const double between = 0.5 * (column(x - period / 2) + column(x + period / 2));
    squares += (column(x) - between) * (column(x) - between) / (high - low);
    mean += between / (high - low);
  }
  return std::sqrt(squares) / mean;
}

using FadingThreads = GlTest;

// The mean of light is linear, so that what is seen from afar must be the mean of what is seen from close up:
// the weft of denim lies in the shade of the warp, and counts by the light that it gets.
TEST_F(FadingThreads, HaveTheColourOfTheirMean) {
  const Image close = swatchOf("denim", 3, 0, 0, 0, FEW_EXPOSURES),
              far = swatchOf("denim", 0.1, 0, 0, 0, FEW_EXPOSURES);
  for (const std::size_t channel : {0u, 1u, 2u}) {
    const double expected = spreadOf(close, channel).mean;
    EXPECT_GT(spreadOf(close, channel).deviation, 0.12 * expected) << "threads are to be seen from close up";
    EXPECT_NEAR(spreadOf(far, channel).mean, expected, 0.06 * expected) << "channel " << channel;
  }
}

// Moire is a pattern where none can be: a period of four threads is below two pixels.
class Moire : public GlTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(Moire, IsNotThere) {
  for (const double pixels : {0.47, 0.13}) {
    const Spread spread = spreadOf(swatchOf(GetParam(), pixels), 1);
    EXPECT_LT(spread.deviation, 0.02 * spread.mean) << pixels << " pixels a thread";
  }
}

INSTANTIATE_TEST_SUITE_P(OfFadingThreads, Moire,
                         ::testing::Values("plain", "twill", "satin", "jersey", "velvet"),
                         [](const auto& weave) { return std::string(weave.param); });

// Seen at 6 degrees off its plane the courses of a knit are too close for pixels, the wales beside each other
// are not.
TEST_F(FadingThreads, FadeAlongTheDirectionInWhichTheyAreTooFine) {
  EXPECT_GT(columnContrast(swatchOf("jersey", 8, 84, 1), 8), 0.04);
}

// How much light differs between neighbours two pixels above each other, over how much it does beside each
// other.
double upOverAcross(const Image& image) {
  const int low = MARGIN, high = SWATCH_PIXELS - low;
  double up = 0, across = 0;
  for (int y = low; y < high; ++y)
    for (int x = low; x < high; ++x) {
      const double here = linearLight(test::pixelAt(image, x, y)[1]);
      up += std::abs(linearLight(test::pixelAt(image, x, y + 2)[1]) - here);
      across += std::abs(linearLight(test::pixelAt(image, x + 2, y)[1]) - here);
    }
  return up / across;
}

// The face of a knit has columns, its reverse rows.
TEST_F(FadingThreads, OfAKnitAreRowsFromBehind) {
  const double face = upOverAcross(swatchOf("jersey", 12, 0, 1)),
               reverse = upOverAcross(swatchOf("jersey", 12, 180, 1));
  EXPECT_LT(face, 1.0);
  EXPECT_GT(reverse, 1.3 * face);
}

// What floats on the face of satin is the warp, along v, and on its reverse the weft.
TEST_F(FadingThreads, OfSatinFloatAcrossOnItsReverse) {
  const double face = upOverAcross(swatchOf("satin", 12, 0, 1)),
               reverse = upOverAcross(swatchOf("satin", 12, 180, 1));
  EXPECT_LT(face, 0.8);
  EXPECT_GT(reverse, 1.6 * face);
}

// The reverse of denim is pale with flecks of the warp.
TEST_F(FadingThreads, OfDenimArePaleOnItsReverse) {
  const Image face = swatchOf("denim", 0.1, 0, 0, 0, FEW_EXPOSURES),
              reverse = swatchOf("denim", 0.1, 180, 0, 0, FEW_EXPOSURES);
  EXPECT_GT(spreadOf(reverse, 0).mean, 3 * spreadOf(face, 0).mean);
  const Spread close = spreadOf(swatchOf("denim", 6, 180, 0, 0, FEW_EXPOSURES), 0);
  EXPECT_GT(close.deviation, 0.15 * close.mean);
}

// Satin shines less on its reverse, which is to be seen where light comes back as from a mirror.
TEST_F(FadingThreads, OfSatinAreDullOnItsReverse) {
  const auto shine = [](double angle) {
    return spreadOf(swatchOf("satin", 0.1, angle, 0, 1, FEW_EXPOSURES), 1).mean -
           spreadOf(swatchOf("satin", 0.1, angle, 0, 0, FEW_EXPOSURES), 1).mean;
  };
  EXPECT_GT(shine(0), 0.05);
  EXPECT_LT(shine(180), 0.8 * shine(0));
}

void expectFadingSeen(const std::string& from, const std::string& to, const std::string& test) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change("render/threads.glsl", from, to))
      << "the shader has changed: so must this test";
  const test::CommandResult result = resources.runTests(test);
  EXPECT_NE(result.output.find("FAILED  ] " + test), std::string::npos) << result.output;
}

TEST(BrokenFading, AWeftThatGetsAsMuchLightAsTheWarpFromAfarIsSeen) {
  expectFadingSeen("stored.a / max(stored.b, 0.01)", "stored.a / 0.82",
                   "FadingThreads.HaveTheColourOfTheirMean");
}
TEST(BrokenFading, ThreadsThatDoNotFadeAreSeen) {
  expectFadingSeen("log2(0.5 * width * float(textureSize(weave, 0).x))", "0.0",
                   "OfFadingThreads/Moire.IsNotThere/jersey");
}
TEST(BrokenFading, ThreadsThatFadeAlikeInAllDirectionsAreSeen) {
  expectFadingSeen("MOST_OBLIQUE = 16.0", "MOST_OBLIQUE = 1.0",
                   "FadingThreads.FadeAlongTheDirectionInWhichTheyAreTooFine");
}

TEST(BrokenFading, AReverseThatIsTheFaceIsSeen) {
  expectFadingSeen("side < 0.0 && !isKnit()", "false", "FadingThreads.OfSatinFloatAcrossOnItsReverse");
}
TEST(BrokenFading, AKnitWhoseReverseIsItsFaceIsSeen) {
  expectFadingSeen("if (side < 0.0) slope", "if (false) slope", "FadingThreads.OfAKnitAreRowsFromBehind");
}

}  // namespace
}  // namespace clothsim
