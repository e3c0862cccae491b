// Pictures that are the mean of exposures, against geometry.
#include <cmath>
#include <numbers>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "render/exposure.h"
#include "solver/solver.h"

namespace clothsim {
namespace {

using test::drapeScene;
using test::drawDrape;
using test::meanDifference;

using ExposuresTest = GlTest;

constexpr int SIZE = 160;  // of the square pictures below [pixels]

// Half of what a picture shows at a distance of 1, with the default field of view.
const double halfView = std::tan(35 * std::numbers::pi / 360);

// A ball over a floor, with a cloth too small to matter.
Scene ballScene(Vec3d center, double radius) {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.numWidthPoints = cloth.numHeightPoints = 2;
  cloth.width = cloth.height = 0.001;
  cloth.position = {0, -0.99, 0};
  scene.colliders = {Sphere{.origin = center, .radius = radius, .motion = std::nullopt}, Plane{}};
  scene.render.light = Vec3d{1, 1, 0};
  return scene;
}

Image exposed(const Scene& scene, int exposures, bool shadows = true) {
  RenderOptions options = forExposures({}, FINAL_EXPOSURES);
  options.shadowMapSize = 512;
  options.shadows = shadows;
  const Cloth cloth(scene);
  const State state = initialState(cloth, scene);
  const gl::Buffer<Particle4> positions("positions", state.positions);
  Renderer renderer(cloth, scene, options);
  return renderImage(renderer, positions.name(), Camera(scene, cloth), 0, SIZE, SIZE, exposures);
}

// What was light before the curves of tone and of sRGB (shaders/render/tone.glsl).
double lightAt(const Image& image, int x, int y) {
  const double stored = test::pixelAt(image, x, y)[1] / 255.0, knee = 0.65;
  const double mapped = stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
  const double above = std::max(mapped - knee, 0.0);
  return std::min(mapped, knee) + above / (1 - above / (1 - knee));
}

// Over how many pixels light rises from a tenth to nine tenths between two pixels.
template <class At>
double widthOfEdge(int from, int to, At at) {
  const double low = at(from), high = at(to);
  const int step = to > from ? 1 : -1;
  const auto crossing = [&](double part) {
    const double level = low + part * (high - low);
    for (int i = from; i != to; i += step)
      if ((at(i) - level) * (at(i + step) - level) <= 0 && at(i) != at(i + step))
        return i + step * (level - at(i)) / (at(i + step) - at(i));
    return double(to);
  };
  return std::abs(crossing(0.9) - crossing(0.1));
}

// Of an edge behind which a disc comes up: the parts of its area from a tenth to nine tenths, over its
// diameter.
constexpr double DISC_RISE = 0.687;

TEST_F(ExposuresTest, AreSpreadEvenly) {
  const std::vector<Exposure> exposures = makeExposures(64);
  ASSERT_EQ(exposures.size(), 64u);
  glm::vec2 pixel(0), lens(0), light(0);
  glm::vec3 sky(0);
  float squares = 0;
  for (const Exposure& exposure : exposures) {
    pixel += exposure.pixel / 64.0f;
    lens += exposure.lens / 64.0f;
    light += exposure.light / 64.0f;
    for (const glm::vec3& direction : exposure.sky) {
      sky += direction / (64.0f * SKY_DIRECTIONS);
      EXPECT_NEAR(glm::length(direction), 1, 1e-5f);
    }
    squares += glm::dot(exposure.light, exposure.light) / 64;
    EXPECT_LE(glm::length(exposure.lens), 1);
  }
  for (const float off : {glm::length(pixel), glm::length(lens), glm::length(light), glm::length(sky)})
    EXPECT_LT(off, 0.05f);
  EXPECT_NEAR(squares, 0.5, 0.02) << "of a disc";
}

TEST_F(ExposuresTest, GiveTheSamePictureTwiceAndABetterOneTheMoreThereAre) {
  const test::Drape drape(drapeScene());
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  RenderOptions options = forExposures({}, FINAL_EXPOSURES);
  options.shadowMapSize = 512;
  Renderer renderer(drape.cloth, drape.scene, options);
  const Camera camera(drape.scene, drape.cloth);
  const auto picture = [&](int exposures) {
    return renderImage(renderer, positions.name(), camera, 0, test::pictureWidth, test::pictureHeight,
                       exposures);
  };
  const Image plain = picture(1), few = picture(8), many = picture(64), best = picture(256);
  EXPECT_EQ(picture(64).rgb, many.rgb);
  EXPECT_EQ(picture(1).rgb, plain.rgb) << "exposures leave nothing behind";
  EXPECT_LT(meanDifference(many, best), 0.5 * meanDifference(few, best));
  EXPECT_LT(meanDifference(many, best), 0.7);
  EXPECT_LT(meanDifference(plain, best), 8) << "the same light, but for what is in its way";
}

// Seen from above, beside the ball. The penumbra is as wide as the light's disc, seen from its edge.
TEST_F(ExposuresTest, SoftenAShadowByTheSizeOfTheLight) {
  constexpr double HEIGHT = 0.6, RADIUS = 0.25, ABOVE = 2.5;
  Scene scene = ballScene({0, HEIGHT, 0}, RADIUS);
  scene.camera.position = Vec3d{-HEIGHT, ABOVE, 1e-3};
  scene.camera.target = Vec3d{-HEIGHT, 0, 0};
  for (const double degrees : {4.0, 14.0}) {
    scene.render.lightSize = degrees;
    const double penumbra = std::numbers::sqrt2 * HEIGHT * 2 * std::tan(degrees * std::numbers::pi / 360);
    const double pixels = SIZE / (2 * ABOVE * halfView);
    const Image shaded = exposed(scene, 64), lit = exposed(scene, 64, false);
    const double width = widthOfEdge(
        SIZE / 2, SIZE - 8, [&](int y) { return lightAt(shaded, SIZE / 2, y) / lightAt(lit, SIZE / 2, y); });
    EXPECT_NEAR(width, DISC_RISE * penumbra * pixels, 0.25 * DISC_RISE * penumbra * pixels + 1.5) << degrees;
  }
}

// A ball of radius R that lies on the floor takes (R/D)^3 of the sky's light from a place of the floor, with
// D the distance of its middle. The main light comes from below, so that the floor has the sky's and the fill
// light alone, the same everywhere: ratios of what is lost do not depend on how strong they are.
TEST_F(ExposuresTest, DarkenTheFloorNextToABall) {
  constexpr double RADIUS = 0.3, ABOVE = 3;
  Scene scene = ballScene({0, RADIUS, 0}, RADIUS);
  scene.render.light = Vec3d{0, -1, 0};
  scene.camera.position = Vec3d{0, ABOVE, 1e-3};
  scene.camera.target = Vec3d{0, 0, 0};
  const Image shaded = exposed(scene, 128), lit = exposed(scene, 128, false);
  const auto lost = [&](double distance) {
    const int x = SIZE / 2 + static_cast<int>(std::lround(distance * SIZE / (2 * ABOVE * halfView)));
    double sum = 0;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -4; dy <= 4; ++dy)
        sum += 1 - lightAt(shaded, x + dx, SIZE / 2 + dy) / lightAt(lit, x + dx, SIZE / 2 + dy);
    return sum;
  };
  const auto taken = [&](double distance) { return std::pow(RADIUS / std::hypot(RADIUS, distance), 3); };
  const double near = 1.2 * RADIUS, far = 2.2 * RADIUS;
  EXPECT_NEAR(lost(near) / lost(far) / (taken(near) / taken(far)), 1, 0.25);
}

// A ball at the distance of focus is sharp; otherwise its edge is as wide as the circle of confusion.
TEST_F(ExposuresTest, BlurWhatIsOutOfFocus) {
  constexpr double DISTANCE = 3, APERTURE = 0.2;
  Scene scene = ballScene({0, 1.5, 0}, 0.4);
  scene.colliders.pop_back();
  scene.render.ground = false;
  scene.render.background = "plain";
  scene.render.backgroundColor = {0, 0, 0};
  scene.render.light = Vec3d{0, -0.2, -1};  // from behind: the ball is evenly lit
  scene.camera.position = Vec3d{0, 1.5, DISTANCE};
  scene.camera.target = Vec3d{0, 1.5, 0};
  scene.camera.aperture = APERTURE;
  const double pixels = SIZE / (2 * DISTANCE * halfView);
  const auto width = [&] {
    const Image image = exposed(scene, 64);
    return widthOfEdge(10, SIZE / 2 - 27, [&](int x) { return lightAt(image, x, SIZE / 2); });
  };
  EXPECT_LT(width(), 3);
  scene.camera.focus = 2;
  const double confusion = APERTURE * (DISTANCE - *scene.camera.focus) / *scene.camera.focus * pixels;
  EXPECT_NEAR(width(), DISC_RISE * confusion, 0.3 * DISC_RISE * confusion);
}

// A dark sheet moves to the right in front of white: its edges are as wide as the way that it goes meanwhile.
TEST_F(ExposuresTest, BlurWhatMovesWhileTheShutterIsOpen) {
  constexpr double SPEED = 6, SHUTTER = 0.02, DISTANCE = 2;
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 9;
  scene.cloths[0].width = scene.cloths[0].height = 0.5;
  scene.render.shader = "diffuse";
  scene.render.color = scene.render.backColor = {0.05, 0.05, 0.05};
  scene.render.background = "plain";
  scene.render.backgroundColor = {1, 1, 1};
  scene.render.ground = false;
  scene.camera.position = Vec3d{0, 0, DISTANCE};
  scene.camera.target = Vec3d{0, 0, 0};
  const Cloth cloth(scene);
  std::vector<Particle4> places, velocities(cloth.particleCount(), {SPEED, 0, 0, 0});
  for (int i = 0; i < 81; ++i)
    places.push_back({0.0625f * float(i % 9) - 0.25f, 0.25f - 0.0625f * float(i / 9), 0, 1});
  const gl::Buffer<Particle4> positions("positions", places), moving("velocities", velocities);
  const auto width = [&](double shutter) {
    scene.camera.shutter = shutter;
    Renderer renderer(cloth, scene, {.samples = 1, .shadowMapSize = 256});
    renderer.setVelocities(moving.name());
    const Image image = renderImage(renderer, positions.name(), Camera(scene, cloth), 0, SIZE, SIZE, 64);
    return widthOfEdge(SIZE / 2, SIZE - 10, [&](int x) { return lightAt(image, x, SIZE / 2); });
  };
  const double way = SPEED * SHUTTER * SIZE / (2 * DISTANCE * halfView);
  EXPECT_LT(width(0), 2);
  EXPECT_NEAR(width(SHUTTER), 0.8 * way, 0.1 * way);
}

}  // namespace
}  // namespace clothsim
