// Pictures of which only the changed part is drawn are those that are drawn whole, in every pixel.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "render/changed_area.h"
#include "render/shadow_map.h"

namespace clothsim {
namespace {

class KeptPictureTest : public GlTest {
 protected:
  static constexpr int width = 192, height = 128;

  // The cloth where it hangs at a moment of its way.
  static std::vector<Particle4> moved(const test::Drape& drape, int moment) {
    std::vector<Particle4> positions = drape.positions;
    for (Particle4& p : positions) {
      p.x += 0.03f * static_cast<float>(moment);
      p.y += 0.02f * static_cast<float>(moment % 3);
    }
    return positions;
  }

  static std::vector<glm::vec4> particlesOf(const test::Drape& drape) {
    std::vector<glm::vec4> particles;
    for (const Particle4& p : drape.positions) particles.emplace_back(p.x, p.y, p.z, p.w);
    return particles;
  }

  struct Shown {
    Shown(const test::Drape& drape, bool keeps, double scale = 1)
        : positions("positions", drape.positions),
          renderer(drape.cloth, drape.scene, {.samples = 1, .keepsStill = keeps}) {
      renderer.setScale(scale);
    }
    Image after(const test::Drape& drape, int moment, const Camera& camera, double time = 0) {
      positions.upload(moved(drape, moment));
      return renderImage(renderer, positions.name(), camera, time, width, height);
    }
    gl::Buffer<Particle4> positions;
    Renderer renderer;
  };

  static void expectTheSame(const Scene& scene, double scale, double secondsAMoment = 0) {
    const test::Drape drape(scene);
    Shown kept(drape, true, scale), whole(drape, false, scale);
    const Camera camera(drape.scene, drape.cloth);
    for (int moment = 0; moment < 5; ++moment) {
      const double time = secondsAMoment * moment;
      EXPECT_EQ(kept.after(drape, moment, camera, time).rgb, whole.after(drape, moment, camera, time).rgb)
          << "moment " << moment << " at scale " << scale;
    }
  }
};

// As KeptPicture has it for the window. A framebuffer that the last picture is not in gets all of it.
TEST_F(KeptPictureTest, WithTheTopFirstIsTheSamePictureTurnedAround) {
  const test::Drape drape(test::drapeScene());
  const Camera camera(drape.scene, drape.cloth);
  const gl::FramebufferFormat format{.width = width, .height = height, .color = GL_RGBA8};
  const std::array targets{gl::Framebuffer("picture", format), gl::Framebuffer("another picture", format)};
  for (const double scale : {1.0, 0.6}) {
    Shown kept(drape, true, scale), turned(drape, true, scale);
    for (int moment = 0; moment < 6; ++moment) {
      const gl::Framebuffer& target = targets[moment / 2 % 2];
      const Image upright = kept.after(drape, moment, camera);
      turned.positions.upload(moved(drape, moment));
      turned.renderer.drawOver(turned.positions.name(), camera, 0, target);
      const std::vector<std::uint8_t> rows = target.readRgb();
      constexpr std::ptrdiff_t rowBytes = 3 * width;
      for (std::ptrdiff_t row = 0; row < height; ++row)
        ASSERT_TRUE(std::equal(rows.begin() + row * rowBytes, rows.begin() + (row + 1) * rowBytes,
                               upright.rgb.begin() + (height - 1 - row) * rowBytes))
            << "row " << row << " of moment " << moment << " at scale " << scale;
    }
  }
}

TEST_F(KeptPictureTest, IsTheWholePictureInEveryPixelWhileTheClothMoves) {
  expectTheSame(test::drapeScene(), 1);
  expectTheSame(test::drapeScene(), 0.5);
}

TEST_F(KeptPictureTest, IsTheWholePictureUnderEveryBackgroundAndShadingModel) {
  for (const char* background : {"studio", "sky", "plain"}) {
    Scene scene = test::drapeScene();
    scene.render.background = background;
    expectTheSame(scene, 0.75);
  }
  for (const char* shader : {"fabric", "wireframe", "displacement"}) {
    Scene scene = test::drapeScene();
    scene.render.shader = shader;
    expectTheSame(scene, 1);
  }
}

// Where nothing throws a shadow on it, the ground is left to the backdrop; solids may be sunk in it. Its far
// edge differs, which is laid over itself where it is drawn.
TEST_F(KeptPictureTest, HasTheGroundOfEveryStageAsIfItWereDrawnEverywhere) {
  for (const std::string_view stage : stages) {
    for (const double middle : {0.5, 0.1}) {
      Scene scene = test::drapeScene();
      scene.render.stage = stage;
      std::get<Sphere>(scene.colliders.front()).origin.y = middle;
      Plane ground;
      ground.normal = {0, 1, 0};
      scene.colliders.emplace_back(ground);
      const test::Drape drape(scene);
      Shown kept(drape, true), whole(drape, false);
      const Camera camera(drape.scene, drape.cloth);
      const Image a = kept.after(drape, 0, camera), b = whole.after(drape, 0, camera);
      std::size_t others = 0;  // but for rounding
      for (std::size_t i = 0; i < a.rgb.size(); ++i)
        if (std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i])) > 1) ++others;
      EXPECT_LE(others, a.rgb.size() / 100) << stage << ", of a ball at a height of " << middle;
    }
  }
}

TEST_F(KeptPictureTest, SeesSolidsThatMoveAndSolidsInTheShadowOfTheCloth) {
  Scene scene = test::drapeScene();
  Capsule low;
  low.origin = {0.55, 0.05, 0.8};
  low.axis = {1, 0, 0};
  low.radius = 0.05;
  scene.colliders.emplace_back(low);
  expectTheSame(scene, 1);
  Sphere travelling;
  travelling.origin = {-0.2, 0.1, 0.5};
  travelling.radius = 0.1;
  travelling.motion = Motion{{{0, {-0.2, 0.1, 0.5}, {}}, {1, {0.8, 0.3, 0.5}, {}}}};
  scene.colliders.emplace_back(travelling);
  expectTheSame(scene, 1, 0.2);
  Box turning;
  turning.origin = {0.6, 0.4, 0.6};
  turning.size = {0.5, 0.1, 0.2};
  turning.motion = Motion{{{0, {0.6, 0.4, 0.6}, {}}, {1, {0.6, 0.4, 0.6}, {0, 200, 70}}}};
  scene.colliders.emplace_back(turning);
  expectTheSame(scene, 0.75, 0.2);
}

TEST_F(KeptPictureTest, DrawsOnlyAPartWhereASolidMoves) {
  Scene scene = test::drapeScene();
  Sphere travelling;
  travelling.origin = {0.5, 0.5, 0.5};
  travelling.radius = 0.1;
  travelling.motion = Motion{{{0, {0.5, 0.5, 0.5}, {}}, {1, {0.6, 0.5, 0.5}, {}}}};
  scene.colliders.emplace_back(travelling);
  const test::Drape drape(scene);
  const Camera camera(drape.scene, drape.cloth);
  const Stage stage = makeStage(outlineOf(drape.cloth), drape.scene);
  Colliders colliders(8, 8, 0.02);
  colliders.build(drape.scene);
  ShadowMap shadows(64);
  shadows.cover(stage.reach, glm::normalize(glm::vec3(-0.5f, 1, 0.4f)));
  const ChangedArea::View view{camera.projection(1.5) * camera.view(), shadows.shadowFromWorld(), 4 * width,
                               4 * height};
  const std::vector<glm::vec4> atOnePoint(drape.cloth.particleCount(), {0.5f, 0.8f, 0.3f, 1});
  const auto place = ChangedArea::placeOf(drape.cloth, atOnePoint, view);
  ASSERT_TRUE(place);
  ChangedArea changes;
  const auto pixelsAt = [&](double time) -> std::optional<int> {
    colliders.place(drape.scene, stage, time);
    const auto area = changes.next(view, *place, colliders);
    if (!area) return std::nullopt;
    return area->picture.width() * area->picture.height();
  };
  EXPECT_FALSE(pixelsAt(0)) << "the first picture is new everywhere";
  const auto still = pixelsAt(0), moved = pixelsAt(1);
  ASSERT_TRUE(still && moved);
  EXPECT_GT(*moved, *still);
  EXPECT_LT(*moved, 0.9 * 16 * width * height);
}

TEST_F(KeptPictureTest, FollowsTheCameraTheSceneAndTheSize) {
  const test::Drape drape(test::drapeScene());
  Shown kept(drape, true), whole(drape, false);
  Camera camera(drape.scene, drape.cloth);
  static_cast<void>(kept.after(drape, 0, camera));
  camera.orbit(0.4, 0.1);
  EXPECT_EQ(kept.after(drape, 0, camera).rgb, whole.after(drape, 0, camera).rgb);
  Scene other = drape.scene;
  other.render.color = {0.1, 0.5, 0.2};
  kept.renderer.configure(other);
  whole.renderer.configure(other);
  EXPECT_EQ(kept.after(drape, 0, camera).rgb, whole.after(drape, 0, camera).rgb);
  kept.renderer.setScale(0.5);
  whole.renderer.setScale(0.5);
  EXPECT_EQ(kept.after(drape, 0, camera).rgb, whole.after(drape, 0, camera).rgb);
  for (Shown* shown : {&kept, &whole}) shown->renderer.setView({.showPins = true});
  EXPECT_EQ(kept.after(drape, 1, camera).rgb, whole.after(drape, 1, camera).rgb);
}

// Of which a software renderer draws the ground and what is behind it apart once the camera turns.
TEST_F(KeptPictureTest, HasTheBackdropOfAPictureThatIsDrawnAtOnce) {
  for (const std::string_view stage : stages) {
    Scene scene = test::drapeScene();
    scene.render.stage = stage;
    const test::Drape drape(scene);
    Shown turning(drape, true);
    Camera camera(drape.scene, drape.cloth);
    static_cast<void>(turning.after(drape, 0, camera));
    for (int turn = 0; turn < 6; ++turn) {
      camera.orbit(0.9, turn % 2 == 0 ? 0.35 : -0.5);
      camera.zoom(turn % 3 == 0 ? 2 : 0.6);
      Shown atOnce(drape, true);
      EXPECT_EQ(turning.after(drape, 0, camera).rgb, atOnce.after(drape, 0, camera).rgb)
          << stage << ", turn " << turn;
    }
  }
}

TEST_F(KeptPictureTest, DrawsOnlyAPartOfItAndAllOfItWhereThatIsUnknown) {
  const test::Drape drape(test::drapeScene());
  const Camera camera(drape.scene, drape.cloth);
  const Stage stage = makeStage(outlineOf(drape.cloth), drape.scene);
  Colliders colliders(8, 8, 0.02);
  colliders.build(drape.scene);
  colliders.place(drape.scene, stage, 0);
  ChangedArea changes;
  const glm::mat4 clip = camera.projection(1.5) * camera.view();
  ShadowMap shadows(64);
  shadows.cover(stage.reach, glm::normalize(glm::vec3(-0.5f, 1, 0.4f)));
  std::vector<glm::vec4> particles = particlesOf(drape);
  ChangedArea::View view{clip, shadows.shadowFromWorld(), width, height};
  const auto place = ChangedArea::placeOf(drape.cloth, particles, view);
  ASSERT_TRUE(place);
  EXPECT_FALSE(changes.next(view, *place, colliders)) << "the first picture is new everywhere";
  const auto area = changes.next(view, *place, colliders);
  ASSERT_TRUE(area);
  EXPECT_LT(area->picture.width() * area->picture.height(), 0.9 * width * height);
  EXPECT_GT(area->picture.width() * area->picture.height(), 0.05 * width * height);
  Camera turned = camera;
  turned.orbit(0.1, 0);
  view.clipFromWorld = turned.projection(1.5) * turned.view();
  const auto orbited = changes.next(view, *place, colliders);
  ASSERT_TRUE(orbited);
  EXPECT_EQ(orbited->picture, (PixelRect{0, 0, width, height}));
  EXPECT_EQ(orbited->shadow.low, area->shadow.low) << "the light does not turn with the camera";
  particles[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(ChangedArea::placeOf(drape.cloth, particles, view)) << "who is nowhere may be anywhere";
}

// A stretched diagonal of cloth covers a rectangle's corners alone.
TEST_F(KeptPictureTest, FollowsTheOutlineOfShadows) {
  const test::Drape drape(test::drapeScene());
  std::vector<glm::vec2> places;
  const std::size_t count = drape.cloth.particleCount();
  for (std::size_t i = 0; i < count; ++i)
    places.emplace_back(static_cast<float>(i) / static_cast<float>(count - 1));
  const ShadowFootprint diagonal = footprintOf(drape.cloth, places, 0);
  int cells = 0;
  for (int row = 0; row < ShadowFootprint::CELLS; ++row)
    for (int column = 0; column < ShadowFootprint::CELLS; ++column)
      cells += diagonal.has(column, row) ? 1 : 0;
  EXPECT_GE(cells, ShadowFootprint::CELLS);
  EXPECT_LT(cells, ShadowFootprint::CELLS * ShadowFootprint::CELLS / 4);
  EXPECT_EQ(diagonal.bounds().low, glm::vec2(0));
  EXPECT_EQ(diagonal.bounds().high, glm::vec2(1));
  EXPECT_FALSE(ShadowFootprint{}.overlaps(diagonal));
  PixelBands bands(width, height);
  bands.add({{-50, 40}, {20, 70}});
  for (const PixelRect& band : bands.bands())
    EXPECT_EQ(band.width(), band.top > 40 && band.bottom < 70 ? 20 : 0) << "from " << band.bottom;
}

TEST_F(KeptPictureTest, OfHalfTheScaleShowsTheSameSceneSofter) {
  const test::Drape drape(test::drapeScene());
  const Camera camera(drape.scene, drape.cloth);
  Shown full(drape, false), half(drape, false, 0.5);
  const Image a = full.after(drape, 0, camera), b = half.after(drape, 0, camera);
  EXPECT_EQ(a.width, b.width);
  EXPECT_NE(a.rgb, b.rgb);
  EXPECT_LT(test::meanDifference(a, b), 4);
}

}  // namespace
}  // namespace clothsim
